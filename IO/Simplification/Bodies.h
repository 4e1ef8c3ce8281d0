// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/Poll.h"
#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** A body of a simplified surface keeps at least so many vertices, or all that it has. */
inline constexpr std::int64_t VerticesOfBody = 20;

/** The smallest bodies of a surface. */
struct SmallBodies
{
  std::size_t number = 0;
  std::vector<std::uint8_t> hasTriangle; ///< of each triangle of the surface, unless there are none
  /** Whether the bodies have at most three triangles on average: then the triangles of one surface
   * do not share their vertices, and none of them is small. */
  bool areFragments = false;
};

/** Whether a surface of so many vertices and triangles may have fragments for bodies, which
 * collapses could have made as small. A disc of three triangles has five vertices. */
inline bool mayBeFragments(std::int64_t vertices, std::int64_t triangles)
{
  return 3 * vertices >= 5 * triangles;
}

/** Finds the smallest bodies of a surface, by the diagonals of their bounds, without which
 * `vertices` are enough for VerticesOfBody in each that is left, at least one; with fewer than
 * VerticesOfBody to spare, if there are any. Bodies with a locked vertex, which may be parts of
 * larger ones, are none, and do not count. */
SmallBodies smallBodies(const SurfacePart& part, std::span<const std::uint8_t> locked,
  std::int64_t vertices, bool mayBeFragments, const Poll& poll = Poll());

/** Removes what smallBodies() has found. */
void removeBodies(SurfacePart& part, const SmallBodies& bodies, const Poll& poll = Poll());

} // namespace smg
