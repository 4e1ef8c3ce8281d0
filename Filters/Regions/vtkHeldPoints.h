// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/SoughtIds.h"
#include "Solver/Projection/PointProjection.h"

#include <cstdint>
#include <span>
#include <vector>

class vtkPointSet;

namespace smg
{

/** The held points of a piece and their holders. A *holder* is a point of the region: a selected
 * point, an id, a position, or the region as a whole. */
struct HeldPoints
{
  std::vector<std::int64_t> by; ///< index of the holder of each point; -1: free
  std::int64_t holders = 0;
  /** The position of the mesh point at each holder; empty: each point is its own anchor. */
  std::vector<double> anchors;
};

/** The points of the mesh whose `ids` (one per point) are in the list. */
HeldPoints heldByIds(std::span<const std::int64_t> ids, const SoughtIds& sought);

/** The points of the mesh, with their stream indices, in the range of the projected points. */
HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection);

} // namespace smg
