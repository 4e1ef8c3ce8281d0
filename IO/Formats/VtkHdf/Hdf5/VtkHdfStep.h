// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace smg
{

class Hdf5File;

/** A time step of a VTKHDF file: the offsets of its partitions, points and cells in the datasets,
 * which hold those of all time steps consecutively. A file without time steps has one. */
class VtkHdfStep
{
public:
  /** Throws Error if the file has no time step of this number, from 0. */
  VtkHdfStep(const Hdf5File& file, std::int64_t step);

  /** The number of time steps of the file; 0: none. */
  std::int64_t steps() const { return this->Steps; }

  /** The count or offset of this time step in the file, in one of several columns; `otherwise` if
   * there is none. */
  std::int64_t number(const std::string& name, std::int64_t otherwise, std::size_t column = 0,
    std::size_t columns = 1) const;

  struct Partitions
  {
    std::int64_t first = 0, count = 0;
  };
  /** Those of this time step among `all` of the file. Throws Error if there are none. */
  Partitions partitions(std::int64_t all) const;

private:
  std::int64_t nextPartition(std::int64_t first, std::int64_t all) const;

  const Hdf5File& File;
  std::int64_t Step, Steps = 0;
};

/** Counts and offsets above this are invalid. */
inline constexpr std::int64_t VtkHdfMostRows = std::int64_t(1) << 48;

} // namespace smg
