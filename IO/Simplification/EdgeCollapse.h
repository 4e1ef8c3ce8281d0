// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfaceParts.h"
#include "IO/Simplification/SurfaceTopology.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace smg
{

/** Where collapsing ends: at the number of vertices or at the error, whichever comes first. */
struct CollapseGoal
{
  std::size_t vertices = 0; ///< number that is left
  /** The largest error of a collapse, see collapseEdges(). */
  double error = std::numeric_limits<double>::infinity();
  /** Whether handles and bumps may be cut off, small holes closed, and bodies of four triangles and
   * sheets of one go (LoopCuts), where that costs no more than collapses have by then, or little
   * else is possible. Where nothing else is possible, borders between labels are given up, too, the
   * sides of seams get one vertex at a place, and triangles may turn over. */
  bool mayCut = false;
  /** Whether it also ends where a pass leaves nearly all vertices. */
  bool isRough = false;
};

/** What collapseEdges() did. */
struct Collapsed
{
  double error = 0.0;     ///< the largest of a collapse
  std::size_t bodies = 0; ///< that have gone
  /** Whether borders between labels were given up, since nothing else could collapse. */
  bool crossesBorders = false;
  std::size_t welded = 0; ///< vertices, see weldSeams(), since nothing else could collapse
  bool turns = false;     ///< whether triangles might turn over
};

/** Bytes that collapseEdges() needs for a triangle of a part, in addition to the part itself. */
inline constexpr std::int64_t CollapseBytes = 112;

/**
 * Collapses edges of a surface onto one of their ends, so that each vertex that is left is where it
 * was. The error of a collapse is the distance of the end that stays from the planes of the
 * triangles that were at the vertex that goes, and at all vertices that have gone to it before: the
 * root of the mean of the squares, weighted by areas (Garland and Heckbert 1997). Edges with the
 * smallest error go first, of equal ones the shortest.
 *
 * Unless the goal says otherwise, the topology stays (see SurfaceTopology): bodies, handles and
 * boundary curves stay, and no edge gets more than two triangles. So do the borders between the
 * labels of the part, which are held as boundaries are, and the seams all of whose vertices at a
 * place are in the part (joinSeams()): both sides move together. No triangle turns over. Vertices
 * where the surface is not manifold do not go; how triangles are wound does not matter.
 *
 * Each of several passes over the edges collapses edges that have no end in common, in the order of
 * their errors, up to an error that leaves enough for the pass. About 10 passes leave an eighth of
 * the vertices; each takes O(n) time.
 *
 * @param part the triangles; has only vertices that they use. If it has no quadrics it gets those
 * of its triangles, and for each edge of one triangle that of the plane perpendicular to it, which
 * holds the boundary, and so for both triangles at an edge between labels; not for an edge between
 * two open vertices, which may have other triangles elsewhere.
 * @param open for each vertex: not 0 if it may have more triangles elsewhere, so that it must not
 * go
 * @param goal where to end
 * @param poll called now and then; ends the work by an exception
 */
Collapsed collapseEdges(SurfacePart& part, std::span<const std::uint8_t> open,
  const CollapseGoal& goal, const Poll& poll = Poll());

/** collapseEdges() where it makes no error, apart from rounding, while more than so many vertices
 * are left. */
Collapsed collapseFlat(SurfacePart& part, std::span<const std::uint8_t> open, std::size_t vertices,
  const Poll& poll = Poll());

} // namespace smg
