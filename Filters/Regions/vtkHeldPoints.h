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

/**
 * Which points of a piece are held, and by what. A *holder* is a point of the region: a selected
 * point, an id, a place, or the region as a whole.
 */
struct HeldPoints
{
  std::vector<std::int64_t> by; ///< for each point the number of its holder; -1: free
  std::int64_t holders = 0;
  /** x, y, z of the mesh's point at each holder; empty: each holds the points at its own place. */
  std::vector<double> anchors;
};

/** The points of the mesh whose ids, one a point, are sought. */
HeldPoints heldByIds(std::span<const std::int64_t> ids, const SoughtIds& sought);

/** The points of the mesh, with their stream indices, that the projected points influence. */
HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection);

} // namespace smg
