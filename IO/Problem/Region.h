// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Problem/JsonNode.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace smg
{

/** A part of space, or a set of vertices: selects the vertices of a mesh that something holds for.
 */
class Region
{
public:
  /** x n_x + y n_y + z n_z >= d. */
  struct HalfSpace
  {
    std::array<double, 3> normal{};
    double distance = 0;
  };
  /** All points from `low` to `high`, both included. */
  struct Box
  {
    std::array<double, 3> low{}, high{};
  };
  /** All points at most `radius` from `center`. */
  struct Sphere
  {
    std::array<double, 3> center{};
    double radius = 0;
  };
  /** Vertices by their original numbers, ascending. */
  struct Vertices
  {
    std::vector<std::int64_t> ids;
  };

  template <class Shape>
  explicit Region(Shape shape)
    : What(std::move(shape))
  {
  }

  /**
   * Reads the one of these members that the object has:
   * `halfspace` [nx, ny, nz, d], `box` [x0, y0, z0, x1, y1, z1], `sphere` [x, y, z, r],
   * `vertices` [original numbers]. Throws Error if there is none or more than one, or if it is
   * wrong: not finite, no direction, inside out, a negative radius, no vertices.
   */
  static Region parse(const JsonNode& object);

  /** Whether the vertex at `point` (x, y, z) with this original number is selected. */
  bool contains(std::span<const double, 3> point, std::int64_t id) const;

  /** The middle of a sphere or a box; none of the others. */
  std::optional<std::array<double, 3>> center() const;

  /** The vertices, if the region is a set of these, else null. */
  const Vertices* vertices() const { return std::get_if<Vertices>(&this->What); }

private:
  std::variant<HalfSpace, Box, Sphere, Vertices> What;
};

} // namespace smg
