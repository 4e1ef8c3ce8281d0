// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/CellLabels.h"
#include "IO/Simplification/Poll.h"
#include "Solver/Core/Vector.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/Column.h"
#include "smg/Groups.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The weighted sum of the squared distances of a point from planes (Garland and Heckbert, Surface
 * simplification using quadric error metrics, 1997): x' A x + 2 b' x + c. */
struct Quadric
{
  std::array<double, 6> a{}; ///< xx, yy, zz, xy, xz, yz
  std::array<double, 3> b{};
  double c = 0.0;
  double weight = 0.0;

  /** Adds the plane through a point with this unit normal. */
  void addPlane(const double* normal, const double* point, double w)
  {
    const double x = normal[0], y = normal[1], z = normal[2];
    const double d = -(x * point[0] + y * point[1] + z * point[2]);
    this->add({ { w * x * x, w * y * y, w * z * z, w * x * y, w * x * z, w * y * z },
      { w * d * x, w * d * y, w * d * z }, w * d * d, w });
  }

  void add(const Quadric& other)
  {
    for (std::size_t k = 0; k < 6; ++k)
    {
      this->a[k] += other.a[k];
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->b[k] += other.b[k];
    }
    this->c += other.c;
    this->weight += other.weight;
  }

  /** The weighted mean of the squared distances of the point. */
  double squaredDistance(const double* p) const
  {
    const double x = p[0], y = p[1], z = p[2];
    const double sum = this->a[0] * x * x + this->a[1] * y * y + this->a[2] * z * z +
                       2.0 * (this->a[3] * x * y + this->a[4] * x * z + this->a[5] * y * z) +
                       2.0 * (this->b[0] * x + this->b[1] * y + this->b[2] * z) + this->c;
    return this->weight > 0.0 ? std::fabs(sum) / this->weight : 0.0;
  }
};

/** Triangles of a surface with their vertices, in a numbering of their own. */
struct SurfacePart
{
  std::vector<std::int64_t> ids; ///< stream indices of the vertices, all different
  std::vector<double> points;    ///< x, y, z of each vertex
  /** For each vertex the planes of the triangles that were at it, and at vertices that have
   * collapsed onto it, for points relative to `origin`. */
  std::vector<Quadric> quadrics;
  std::array<double, 3> origin{};
  /** For each vertex, if there are quadrics: not 0 if the planes of its boundary edges may be
   * missing. */
  std::vector<std::uint8_t> lacksBoundary;
  std::vector<std::byte> rows;        ///< for each vertex its tuples of all columns
  std::vector<std::uint32_t> corners; ///< places in `ids`, three a triangle
  std::vector<std::byte> cellRows;    ///< for each triangle its tuples of the carried columns
  std::vector<LabelPlace> labels;     ///< in these tuples; collapses keep their borders
  /** Where the row of a triangle has the sets of groups of its edges, each opposite to a corner; of
   * the triangles at an edge, one has it. Collapses keep edges in groups as borders. */
  std::optional<std::size_t> edgeGroups;
  /** Whether the last byte in the row of a vertex says if that is held (1), or lies on a seam with
   * others at its place (their number with it, at most MostOfSeam); else it is 0. */
  bool marksHeld = false;
  static constexpr std::uint8_t MostOfSeam = 255;
  // While seams are joined, see joinSeams():
  std::vector<std::uint32_t> wedges; ///< for each corner the vertex whose row it has
  std::vector<std::uint8_t> atPlace; ///< for each vertex the number of those joined in it

  std::size_t vertices() const { return this->ids.size(); }
  std::size_t triangles() const { return this->corners.size() / 3; }
  const double* point(std::size_t vertex) const { return this->points.data() + 3 * vertex; }
  /** The normal of the triangle of three vertices, as long as twice its area. */
  Vector area(std::size_t a, std::size_t b, std::size_t c) const
  {
    return cross(
      difference(this->point(b), this->point(a)), difference(this->point(c), this->point(a)));
  }
  /** The bytes of the row of a vertex. */
  std::size_t rowBytes() const
  {
    return this->ids.empty() ? 0 : this->rows.size() / this->vertices();
  }

  /** The bytes of the row of a triangle. */
  std::size_t cellRowBytes() const
  {
    return this->cellRows.empty() ? 0 : this->cellRows.size() / this->triangles();
  }

  /** Whether a vertex must stay. */
  bool isHeld(std::size_t vertex) const { return this->mark(vertex) == 1; }
  /** For each vertex 1 if it must stay, else 0. */
  std::vector<std::uint8_t> held() const
  {
    std::vector<std::uint8_t> held(this->vertices());
    for (std::size_t v = 0; v < held.size(); ++v)
    {
      held[v] = this->isHeld(v) ? 1 : 0;
    }
    return held;
  }
  /** The number of vertices at the place of one on a seam, at most MostOfSeam; 0 elsewhere. */
  std::uint8_t seamOf(std::size_t vertex) const
  {
    const std::uint8_t mark = this->mark(vertex);
    return mark > 1 ? mark : std::uint8_t(0);
  }
  /** The number of vertices that are joined in one. */
  std::size_t joinedIn(std::size_t vertex) const
  {
    return this->atPlace.empty() ? 1 : this->atPlace[vertex];
  }
  /** Says how many vertices there are now at the place of one on a seam; 0 and 1: it is on none.
   * A vertex on no seam stays as it is. */
  void setSeam(std::size_t vertex, std::size_t number)
  {
    if (this->seamOf(vertex) > 0)
    {
      this->rows[(vertex + 1) * this->rowBytes() - 1] =
        static_cast<std::byte>(number > 1 ? number : 0);
    }
  }
  /** Makes room for so many triangles, with rows and vertices as those of another surface. */
  void reserve(std::size_t triangles, const SurfacePart& like);
  /** Whether two triangles have the same labels. */
  bool haveSameLabels(std::size_t one, std::size_t other) const
  {
    const std::size_t stride = this->cellRowBytes();
    return std::ranges::all_of(this->labels,
      [&](const LabelPlace& label)
      {
        return std::memcmp(this->cellRows.data() + one * stride + label.begin,
                 this->cellRows.data() + other * stride + label.begin, label.bytes) == 0;
      });
  }

  /** The set of groups of the edge of a triangle that is opposite to its corner k; 0: none. */
  GroupSet edgeSet(std::size_t triangle, std::size_t k) const
  {
    GroupSet set = 0;
    std::memcpy(&set, this->cellRows.data() + this->placeOfEdge(triangle, k), sizeof(set));
    return set;
  }
  void setEdgeSet(std::size_t triangle, std::size_t k, GroupSet set)
  {
    std::memcpy(this->cellRows.data() + this->placeOfEdge(triangle, k), &set, sizeof(set));
  }
  /** Whether a triangle has an edge in a group. */
  bool hasEdgeSets(std::size_t triangle) const
  {
    return this->edgeGroups &&
           (this->edgeSet(triangle, 0) != 0 || this->edgeSet(triangle, 1) != 0 ||
             this->edgeSet(triangle, 2) != 0);
  }
  /** Whether there are borders to keep. */
  bool hasBorders() const { return !this->labels.empty() || this->edgeGroups; }

  /** Appends a vertex of another surface, without its quadric. */
  void addVertex(const SurfacePart& from, std::size_t vertex);
  /** Appends the position and the tuples of a vertex to these. */
  void copyVertex(
    std::size_t vertex, std::vector<double>& positions, std::span<Column> columns) const;
  /** Appends the tuples of a triangle to these. */
  void copyTriangle(std::size_t triangle, std::span<Column> columns) const;
  /** Some triangles of this surface with their vertices, without quadrics. */
  SurfacePart extract(const std::vector<std::uint32_t>& triangles, const Poll& poll = Poll()) const;
  /** Puts a triangle in the place of an earlier one. */
  void moveTriangle(std::size_t from, std::size_t to);
  /** Removes all but the first triangles. */
  void keepTriangles(std::size_t number);
  /** Removes the triangles for whose numbers this is true. */
  template <class Predicate>
  void removeTriangles(const Predicate& goes, const Poll& poll = Poll())
  {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < this->triangles(); ++t)
    {
      poll.at(t);
      if (!goes(t))
      {
        this->moveTriangle(t, kept++);
      }
    }
    this->keepTriangles(kept);
  }
  /** Removes the vertices that no triangle uses; the others keep their order. */
  void dropUnusedVertices(const Poll& poll = Poll());

  template <class State>
  void exchange(State& state)
  {
    state(this->ids, this->points, this->quadrics, this->origin, this->lacksBoundary, this->rows,
      this->corners, this->cellRows);
  }

private:
  std::size_t placeOfEdge(std::size_t triangle, std::size_t k) const
  {
    return triangle * this->cellRowBytes() + *this->edgeGroups + k * sizeof(GroupSet);
  }
  std::uint8_t mark(std::size_t vertex) const
  {
    return this->marksHeld
             ? std::to_integer<std::uint8_t>(this->rows[(vertex + 1) * this->rowBytes() - 1])
             : std::uint8_t(0);
  }
};

/** The columns of the cells that the triangles of a surface carry: all but the numbers and flags
 * that a conversion gives to cells. */
std::vector<ColumnSpec> carriedColumns(const StreamInfo& info);

/** Consecutive triangles of a stream. */
struct StreamPart
{
  SurfacePart surface;
  /** Earlier parts may have the vertices below `begin`, later ones those from `end` on; `end` may
   * be less than `begin`. */
  std::int64_t begin = 0, end = 0;
  std::int64_t endVertex = 0; ///< the number of vertices that were read

  bool isInside(std::size_t vertex) const
  {
    const std::int64_t id = this->surface.ids[vertex];
    return id >= this->begin && id < this->end;
  }
};

/** Cuts a stream of triangles into parts, with the columns of their vertices and cells
 * (carriedColumns()). Cells that repeat a corner, and duplicates (see CellFlag), are left out. A
 * part and the open vertices of the stream are in memory; `pool` accounts for the latter. */
class SurfaceParts
{
public:
  /** Each part has at least `triangles` triangles, in whole blocks; the last one may have fewer.
   * `progress` receives the share of the vertices that was read, if their number is known, and may
   * throw, as may `poll`, which must outlive this. `marksHeld`: see SurfacePart. */
  SurfaceParts(MeshSource& source, bool marksHeld, Pool& pool, std::size_t triangles,
    std::function<void(double)> progress, const Poll& poll);

  /** Replaces `part` by the next one; returns whether there is one. */
  bool next(StreamPart& part);

  /** The number of cells that were read. */
  std::int64_t cells() const { return this->Cells; }
  /** The number of vertices that were read. */
  std::int64_t vertices() const { return this->Vertices; }
  /** The labels of the cells that were read. */
  const CellLabels& labels() const { return this->Labels; }
  /** The share of the area of what was read that the parts of the result have; 1 if that has none.
   */
  double shareOfArea() const
  {
    const auto [given, simplified] = this->Areas;
    return given > 0.0 ? simplified / given : 1.0;
  }
  /** Compares the areas, and those of labels, with those of this surface, which is a part of the
   * result. */
  void addResult(const SurfacePart& surface) { this->addAreas(CellLabels::Simplified, surface); }

private:
  void addAreas(CellLabels::Surface on, const SurfacePart& surface);
  void add(const MeshBlock& block);
  void localise(SurfacePart& surface);

  MeshSource& Source;
  bool MarksHeld;
  std::size_t Least;
  std::function<void(double)> Progress;
  const Poll& Polled;
  std::size_t RowBytes = 0;
  OpenValues<double> Points;
  OpenValues<std::byte> Rows;
  MeshBlock Block;
  std::array<double, 3> Origin{}; ///< the first vertex
  std::vector<std::int64_t> Corners;
  std::vector<std::byte> CellRows; ///< of the triangles with these corners
  CellLabels Labels;
  std::array<double, 2> Areas{}; ///< twice those of the stream and of the result
  std::int64_t Released = 0;     ///< the first open vertex
  std::int64_t Final = 0;        ///< vertices below are not in later cells
  std::int64_t Vertices = 0, Cells = 0;
  bool IsAtEnd = false;
};

} // namespace smg
