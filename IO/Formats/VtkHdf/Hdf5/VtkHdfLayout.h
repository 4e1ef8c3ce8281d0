// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Mesh/Format.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class Hdf5File;

/** The description of the mesh of a VTKHDF file in a time step. */
struct VtkHdfLayout : VtkLayout
{
  std::vector<std::unique_ptr<VtkArrayOpener>> openers; ///< of the datasets
  std::int64_t timeSteps = 0;                           ///< of the file; 0: none
  std::int64_t partitions = 0;                          ///< of the time step
};

/**
 * Reads the layout of a file of the type UnstructuredGrid or PolyData, versions 1 and 2 (VTK File
 * Formats, "VTKHDF"). Each partition is a piece, whose cells name its own points. Throws Error if
 * it has another type or no such part, if counts are inconsistent, or if it needs more than
 * `maxBytes` of memory.
 */
VtkHdfLayout vtkHdfLayout(const Hdf5File& file, const MeshPart& part, std::int64_t maxBytes);

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

/** The root group of all data in a file. */
inline const std::string VtkHdfRoot = "/VTKHDF/";

/** Opens a dataset for the readers of arrays of VTK's files. The file must outlive this object. */
class DatasetOpener : public VtkArrayOpener
{
public:
  DatasetOpener(const Hdf5File& file, std::string name);

  std::unique_ptr<ByteSource> open(
    InputFile& file, const VtkArray& array, Pool& pool) const override;

private:
  const Hdf5File& Hdf;
  std::string Name;
};

} // namespace smg
