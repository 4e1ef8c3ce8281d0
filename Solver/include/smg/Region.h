// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace smg
{

/** A part of space, or a set of vertices: selects the vertices of a mesh that something holds for.
 */
class SMG_EXPORT Region
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

/** Everywhere. */
struct Everywhere
{
};
/** Where a column of one number, of the vertices or the cells, has this value. */
struct ColumnTag
{
  std::string column;
  double value = 0;
};
/** Where a column of one number, of the vertices or the cells, is not 0. */
struct ColumnMask
{
  std::string column;
};
/** The vertices nearest to these points, one for each; of several, the first in the stream. */
struct NearestVertices
{
  std::vector<std::array<double, 3>> points;
};

/**
 * A part of a mesh that something holds for.
 *
 * A region, a column of the vertices and points select vertices; cells and facets of the boundary
 * are selected if all their corners are. A column of the cells selects cells, their vertices and
 * their facets. Where vertices and cells have a column of the name, conductivity and field look at
 * that of the cells, everything else at that of the vertices.
 */
using Where = std::variant<Everywhere, Region, ColumnTag, ColumnMask, NearestVertices>;

} // namespace smg
