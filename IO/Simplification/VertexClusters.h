// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/Poll.h"
#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** Merges vertices that are near one another, whatever surface they belong to, into at most
 * `vertices`, and seldom less than 19 of 20 of them: for surfaces whose edges cannot be collapsed
 * since their triangles do not share vertices. Triangles with a corner that is held, where `held`
 * is not 0 (empty: none), stay as they are. Each vertex that is left is where it was. Nothing is
 * left where all triangles are smaller than the distances of so few vertices. */
void clusterVertices(SurfacePart& part, std::span<const std::uint8_t> held, std::size_t vertices,
  const Poll& poll = Poll());

} // namespace smg
