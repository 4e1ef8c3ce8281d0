// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/SoughtIds.h"

#include <cstdint>
#include <span>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Finds the positions of the points of a mesh with given ids. */
class PlacesOfIds
{
public:
  /** `sought` are the `ids`; both must outlive *this. */
  PlacesOfIds(const std::vector<std::int64_t>& ids, const SoughtIds& sought);

  /** Searches the points of a piece, whose ids are `idsOfPoints`. */
  void seek(vtkPointSet& piece, std::span<const std::int64_t> idsOfPoints);

  /** The ids found; of duplicate ids only the first one is marked. */
  const std::vector<char>& isFound() const { return this->IsFound; }

  /** x, y, z of each id, all of which must have been found. */
  std::vector<double> positions() const;

private:
  const std::vector<std::int64_t>& Ids;
  const SoughtIds& Sought;
  std::vector<double> Positions; ///< of the ids that isFound() marks
  std::vector<char> IsFound;
};

} // namespace smg
