// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace smg
{

/** Where collapsing edges ends: at what comes first. */
struct CollapseGoal
{
  std::size_t vertices = 0; ///< so many are left
  /** The largest error of a collapse, see collapseEdges(). */
  double error = std::numeric_limits<double>::infinity();
  /** Whether collapses may close handles and merge sheets, where their error is four times smaller
   * than that of others or no other is possible, so that edges may get more than two triangles.
   * Triangles that lie on each other then are removed. */
  bool mayPinch = false;
};

/** Bytes that collapseEdges() needs for a triangle of a part, beside the part. */
inline constexpr std::int64_t CollapseBytes = 110;

/**
 * Collapses edges of a surface onto one of their ends, so that each vertex that is left is where it
 * was. The error of a collapse is the distance of the end that stays from the planes of the
 * triangles that were at the vertex that goes, and at all that have gone to it before: the root of
 * the mean of the squares, weighted by areas (Garland and Heckbert 1997). Edges of the smallest
 * error go first, of equal ones the shortest.
 *
 * The topology stays (see SurfaceTopology): bodies, handles and boundary curves stay, and no edge
 * gets more than two triangles. No triangle turns over. Vertices where the surface is not manifold
 * do not go; how triangles are wound does not matter.
 *
 * In each of some passes over the edges, those collapse that have no end in common, in the order of
 * their errors, up to an error that leaves enough for the pass: about 10 passes leave an eighth.
 * O(n) each.
 *
 * @param part the triangles; has only vertices that they use. Without quadrics, it gets those of
 * its triangles, and of edges of one triangle that of the plane perpendicular to it, which holds
 * the boundary; not of an edge between two locked vertices, which may have other triangles
 * elsewhere.
 * @param open of each vertex: not 0 for one that may have more triangles elsewhere: it does not go
 * @param goal where to end
 * @return the largest error of a collapse
 */
double collapseEdges(
  SurfacePart& part, std::span<const std::uint8_t> open, const CollapseGoal& goal);

} // namespace smg
