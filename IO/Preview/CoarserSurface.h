// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Triangles between some of the vertices of a surface. */
struct CoarserSurface
{
  std::vector<std::int64_t> vertices; ///< their numbers in the surface, ascending
  std::vector<std::int64_t> corners;  ///< places in `vertices`, three a triangle
};

/**
 * Simplifies a surface in memory by edge collapse, as StreamSimplifier does at its end.
 * @param points x, y, z of each vertex
 * @param corners three a triangle
 * @param locked of each vertex: not 0 for one that stays
 * @param most so many vertices are left, besides the locked ones
 */
SMG_EXPORT CoarserSurface coarserSurface(std::span<const double> points,
  std::span<const std::int64_t> corners, std::span<const std::uint8_t> locked, std::int64_t most);

} // namespace smg
