// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace smg
{

/** A part of space, or a set of vertices, which selects vertices of a mesh. */
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
  /** All points within `radius` of `center`. */
  struct Sphere
  {
    std::array<double, 3> center{};
    double radius = 0;
  };
  /** Vertices by their original indices, from 0, in any order. */
  struct Vertices
  {
    std::vector<std::int64_t> ids;
  };

  Region(HalfSpace shape)
    : What(shape)
  {
  }
  Region(Box shape)
    : What(shape)
  {
  }
  Region(Sphere shape)
    : What(shape)
  {
  }
  Region(Vertices shape);

  /** The error of an invalid region, for example "must have a radius of at least 0"; empty if
   * valid. */
  std::string complaint() const;

  /** Whether the vertex at `point` (x, y, z) with this original index is selected. */
  bool contains(std::span<const double, 3> point, std::int64_t id) const;

  /** The centre of a sphere or a box; none for other regions. */
  std::optional<std::array<double, 3>> center() const;

  /** The vertices, ascending without duplicates, if the region is a set of vertices, else null. */
  const Vertices* vertices() const { return std::get_if<Vertices>(&this->What); }

private:
  std::variant<HalfSpace, Box, Sphere, Vertices> What;
};

} // namespace smg
