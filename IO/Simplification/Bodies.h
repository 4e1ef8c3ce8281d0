// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/Poll.h"
#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** What keepLargestBodies() did. */
struct KeptBodies
{
  std::size_t dropped = 0; ///< bodies
  /** Whether the bodies have at most three triangles on average: then the triangles of one surface
   * do not share their vertices, and all are kept. */
  bool areFragments = false;
};

/** A body of a simplified surface keeps at least so many vertices, or all that it has. */
inline constexpr std::int64_t VerticesOfBody = 20;

/** Removes the smallest bodies of a surface, by the diagonals of their bounds, so that `vertices`
 * are enough for VerticesOfBody in each that is left, at least one; with fewer than VerticesOfBody
 * to spare, if any are removed. Bodies with a locked vertex, which may be parts of larger ones,
 * stay and do not count. */
KeptBodies keepLargestBodies(SurfacePart& part, std::span<const std::uint8_t> locked,
  std::int64_t vertices, const Poll& poll = Poll());

} // namespace smg
