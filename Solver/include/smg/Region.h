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

/** A part of space, or a set of numbered vertices: selects vertices of a mesh. Lengths are in the
 * unit of the mesh. */
class SMG_EXPORT Region
{
public:
  /** All points p with normal . p >= distance. */
  struct HalfSpace
  {
    std::array<double, 3> normal{}; ///< of any length but 0; points into the half-space
    double distance = 0;            ///< from the origin, times the length of `normal`
  };
  /** All points from `low` to `high`, both included. */
  struct Box
  {
    std::array<double, 3> low{};  ///< the smallest x, y and z
    std::array<double, 3> high{}; ///< the largest x, y and z, none below `low`
  };
  /** All points within `radius` of `center`. */
  struct Sphere
  {
    std::array<double, 3> center{}; ///< x, y, z
    double radius = 0;              ///< at least 0
  };
  /** Vertices by their numbers in the original file. */
  struct Vertices
  {
    std::vector<std::int64_t> ids; ///< from 0, in any order, at least one
  };

  /** A half-space. */
  Region(HalfSpace shape)
    : What(shape)
  {
  }
  /** A box. */
  Region(Box shape)
    : What(shape)
  {
  }
  /** A ball. */
  Region(Sphere shape)
    : What(shape)
  {
  }
  /** A set of vertices. */
  Region(Vertices shape);

  /** Why the region is not valid, as "must have a radius of at least 0"; empty if it is. */
  std::string complaint() const;

  /** Whether the vertex at `point` (x, y, z) with the original number `id` is selected. */
  bool contains(std::span<const double, 3> point, std::int64_t id) const;

  /** The middle of a sphere or box; none for the other shapes. */
  std::optional<std::array<double, 3>> center() const;

  /** The vertices, ascending and without repetitions; null if the region is another shape. */
  const Vertices* vertices() const { return std::get_if<Vertices>(&this->What); }

  using Shape = std::variant<HalfSpace, Box, Sphere, Vertices>; ///< all shapes
  /** The shape. */
  const Shape& shape() const { return this->What; }

private:
  Shape What;
};

/** All points p with normal . p >= distance: see Region::HalfSpace. */
inline Region halfSpace(const std::array<double, 3>& normal, double distance)
{
  return Region::HalfSpace{ normal, distance };
}
/** All points from `low` to `high`: see Region::Box. */
inline Region box(const std::array<double, 3>& low, const std::array<double, 3>& high)
{
  return Region::Box{ low, high };
}
/** All points within `radius` of `center`: see Region::Sphere. */
inline Region sphere(const std::array<double, 3>& center, double radius)
{
  return Region::Sphere{ center, radius };
}

/** The whole mesh. */
struct Everywhere
{
};
/** Where a column of the vertices or cells with one component has a value. */
struct ColumnTag
{
  std::string column; ///< its name
  double value = 0;   ///< the value
};
/** Where a column of the vertices or cells with one component is not 0. NaN is an error. */
struct ColumnMask
{
  std::string column; ///< its name
};
/** The vertex nearest to each of some points; of equally near ones, the first in the stream. */
struct NearestVertices
{
  std::vector<std::array<double, 3>> points; ///< x, y, z of each point
};

/**
 * The boundary: the ends of the open edges of a surface, which belong to exactly one triangle, or
 * the corners of the faces of exactly one tetrahedron. Cells flagged as duplicates do not count.
 */
struct OnBoundary
{
};

/**
 * What a mesher has named: groups of facets, vertices or cells (MeshGroups). A facet group is its
 * facets and, for values at vertices, their corners. Where several kinds of groups have a name, a
 * value at vertices or facets means facets, then vertices, then cells, and a value in cells means
 * cells, then vertices.
 */
struct InGroup
{
  /** Names, or numbers as text, of which any counts; `*` stands for any characters. */
  std::vector<std::string> names;
};

struct Combination;

/**
 * A part of a mesh.
 *
 * A region, a column of the vertices, points and the boundary select vertices; cells and boundary
 * facets are selected if all their corners are. A column of the cells selects cells, their vertices
 * and their facets. If vertices and cells have columns of the same name, conductivity and field
 * refer to that of the cells, everything else to that of the vertices.
 */
using Where = std::variant<Everywhere, Region, ColumnTag, ColumnMask, NearestVertices, OnBoundary,
  InGroup, Combination>;

/** Several parts together, vertex by vertex, cell by cell, facet by facet. */
struct Combination
{
  /** How. */
  enum class Kind
  {
    All, ///< what all of them select
    Any, ///< what any of them selects
    Not  ///< what the only one does not select
  };
  Kind kind = Kind::Any;    ///< how
  std::vector<Where> parts; ///< at least one; of Kind::Not exactly one
};

} // namespace smg
