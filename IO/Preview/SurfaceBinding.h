// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Preview/StreamPreview.h"
#include "smg/Export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * A surface that follows the motion of a coarser one between some of its vertices.
 *
 * Each vertex is bound to the nearest triangle of the coarser surface, of those around the vertex
 * of it that is nearest along edges: not to another sheet that is near. There it is the point with
 * weights b_i, plus an offset h. When the coarser vertices move to c_i, it moves to the sum of
 * b_i (c_i + R_i h), where R_i turns as the surface does at vertex i: its normal, and an edge in
 * the plane perpendicular to it. So rigid motions are exact, details turn with the surface, and
 * vertices of both are where the coarser ones are.
 *
 * Vertices that are held are where they are to be. A body that the coarser surface does not have
 * moves as the mean of its held vertices does; without such it stays where it is.
 */
class SMG_EXPORT SurfaceBinding
{
public:
  /**
   * @param points x, y, z of each vertex
   * @param corners three a triangle
   * @param coarser its vertices are some of these; at least one
   */
  SurfaceBinding(std::span<const double> points, std::span<const std::int64_t> corners,
    const CoarserSurface& coarser);

  /** Where the vertices are when those of the coarser surface are at `moved`: x, y, z of each.
   * `held`: of each vertex not 0 if it is to be at its place in `targets`; both may be empty. */
  std::vector<double> follow(std::span<const double> moved, std::span<const std::uint8_t> held = {},
    std::span<const double> targets = {}) const;

private:
  /** The columns of a rotation: an edge, and the normal. */
  using Frame = std::array<double, 9>;
  struct Bond
  {
    std::array<std::uint32_t, 3> to; ///< coarser vertices
    std::array<double, 3> weights;
    std::array<double, 3> offset;
  };

  static std::array<double, 3> turned(
    const Frame& before, const Frame& after, const std::array<double, 3>& offset);
  std::vector<Frame> framesOf(std::span<const double> places) const;
  std::vector<std::uint32_t> nearestAlongEdges(
    std::span<const double> points, std::span<const std::int64_t> corners) const;
  void findLooseBodies(std::span<const double> points, std::span<const std::int64_t> corners,
    std::span<const std::uint32_t> nearest);
  void moveLooseBodies(std::span<const std::uint8_t> held, std::vector<double>& places) const;
  std::span<const std::uint32_t> around(std::uint32_t vertex) const
  {
    return { this->Around.data() + this->Begin[vertex],
      this->Begin[vertex + 1] - this->Begin[vertex] };
  }
  Bond bondOf(const double* point, std::uint32_t nearest) const;

  CoarserSurface Coarser;
  std::vector<std::size_t> Begin;    ///< in Around, of each coarser vertex
  std::vector<std::uint32_t> Around; ///< its triangles
  std::vector<double> Places;        ///< of the coarser vertices, before they move
  std::vector<Frame> Frames;
  std::vector<Bond> Bonds;
  /** A vertex of a body that the coarser surface does not have. */
  struct Loose
  {
    std::uint32_t vertex, body; ///< the body: the place of its first vertex in this list
    std::array<double, 3> place;
  };
  std::vector<Loose> LooseVertices;
};

} // namespace smg
