// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** The number of bodies that a simplified surface with so many vertices may have. */
std::size_t bodiesFor(std::int64_t vertices);

/** What keepLargestBodies() did. */
struct KeptBodies
{
  std::size_t dropped = 0; ///< bodies
  /** Whether the bodies have at most three triangles on average: then the triangles of one surface
   * do not share their vertices, and all are kept. */
  bool areFragments = false;
};

/** Removes the smallest bodies of a surface, by the diagonals of their bounds, so that at most
 * `most` are left. Bodies with a locked vertex, which may be parts of larger ones, stay and do not
 * count. */
KeptBodies keepLargestBodies(
  SurfacePart& part, std::span<const std::uint8_t> locked, std::size_t most);

} // namespace smg
