// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Testing/Support/TestMeshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace smg::testing
{

/**
 * One surface as two meshes: `stitched` has vertices on edges that not all triangles of the edge
 * know, and triangles without area between these and the others; `plain` has the same points with
 * none of these. Edges that are cut may be of triangles without area themselves.
 */
class StitchedSurface
{
public:
  using Point = std::array<double, 3>;

  explicit StitchedSurface(IndexedTestMesh mesh)
    : stitched(mesh)
    , plain(std::move(mesh))
    , faces(static_cast<std::size_t>(this->plain.vertices()))
  {
    for (std::int64_t v = 0; v < this->plain.vertices(); ++v)
    {
      this->same.push_back(v);
    }
    for (std::size_t c = 0; c < this->plain.corners.size(); ++c)
    {
      this->faces[at(this->plain.corners[c])].insert(c / 3);
    }
  }

  /** Cuts a random edge, in some of its triangles only. */
  void cut(Random& random)
  {
    const std::vector<std::int64_t>& corners = this->stitched.corners;
    const std::size_t c = at(random.below(std::ssize(corners)));
    const std::int64_t a = corners[c], b = corners[c % 3 == 2 ? c - 2 : c + 1];
    const Point p = between(this->pointOf(a), this->pointOf(b), 0.25 * double(1 + random.below(3)));
    if (this->pointOf(a) == this->pointOf(b))
    {
      return;
    }
    const std::int64_t v = addPoint(this->stitched, p);
    std::set<std::size_t> both;
    std::ranges::set_intersection(
      this->faces[at(a)], this->faces[at(b)], std::inserter(both, both.end()));
    this->faces.push_back(std::move(both));
    this->same.push_back(this->place(p));
    bool isStitched = false;
    for (std::size_t t = 0, count = corners.size() / 3; t < count; ++t)
    {
      if (hasEdge(this->stitched, t, a, b))
      {
        const bool isCut = t == c / 3 || random.below(3) == 0;
        isStitched = isStitched || !isCut;
        if (isCut)
        {
          split(this->stitched, t, a, b, v);
        }
      }
    }
    if (isStitched)
    {
      this->stitched.corners.insert(this->stitched.corners.end(), { a, b, v });
    }
  }

  /** Makes a vertex of `plain` of a point on the surface, unless there is one: cuts the edge that
   * it is on in all triangles, or the triangle. */
  std::int64_t place(const Point& p)
  {
    constexpr double Same = 1e-13;
    for (std::int64_t v = 0; v < this->plain.vertices(); ++v)
    {
      if (distance(pointIn(this->plain, v), p) < Same)
      {
        return v;
      }
    }
    std::int64_t a = -1, b = -1;
    const std::vector<std::int64_t>& corners = this->plain.corners;
    for (std::size_t c = 0; c < corners.size() && a < 0; ++c)
    {
      const std::int64_t from = corners[c], to = corners[c % 3 == 2 ? c - 2 : c + 1];
      const Point one = pointIn(this->plain, from), other = pointIn(this->plain, to);
      if (distance(one, p) + distance(p, other) < (1 + Same) * distance(one, other))
      {
        a = from;
        b = to;
      }
    }
    const std::int64_t v = addPoint(this->plain, p);
    for (std::size_t t = 0, count = corners.size() / 3; a < 0 && t < count; ++t)
    {
      this->cutInside(t, v);
    }
    for (std::size_t t = 0, count = corners.size() / 3; a >= 0 && t < count; ++t)
    {
      if (hasEdge(this->plain, t, a, b))
      {
        split(this->plain, t, a, b, v);
      }
    }
    return v;
  }

  /** Of `stitched`. */
  Point pointOf(std::int64_t v) const { return pointIn(this->stitched, v); }
  static Point between(const Point& a, const Point& b, double share)
  {
    return { a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]),
      a[2] + share * (b[2] - a[2]) };
  }

  IndexedTestMesh stitched, plain;
  std::vector<std::int64_t> same; ///< the vertex of `plain` at each vertex of `stitched`
  /** The triangles of the first mesh that each vertex of `stitched` is in. */
  std::vector<std::set<std::size_t>> faces;

private:
  static std::size_t at(std::int64_t number) { return static_cast<std::size_t>(number); }
  static Point pointIn(const IndexedTestMesh& mesh, std::int64_t v)
  {
    const double* const p = &mesh.positions[3 * at(v)];
    return { p[0], p[1], p[2] };
  }
  static double distance(const Point& a, const Point& b)
  {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }

  static std::int64_t addPoint(IndexedTestMesh& mesh, const Point& p)
  {
    mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    return mesh.vertices() - 1;
  }
  static bool hasEdge(const IndexedTestMesh& mesh, std::size_t t, std::int64_t a, std::int64_t b)
  {
    const auto begin = mesh.corners.begin() + std::ptrdiff_t(3 * t);
    return std::find(begin, begin + 3, a) != begin + 3 &&
           std::find(begin, begin + 3, b) != begin + 3;
  }
  /** Makes two triangles of one. */
  static void split(
    IndexedTestMesh& mesh, std::size_t t, std::int64_t a, std::int64_t b, std::int64_t v)
  {
    std::array<std::int64_t, 3> other{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::int64_t& corner = mesh.corners[3 * t + k];
      other[k] = corner == a ? v : corner;
      corner = corner == b ? v : corner;
    }
    mesh.corners.insert(mesh.corners.end(), other.begin(), other.end());
  }

  /** Makes three triangles of one if the vertex is in it. */
  void cutInside(std::size_t t, std::int64_t v)
  {
    constexpr double Same = 1e-12;
    const std::int64_t* const corner = &this->plain.corners[3 * t];
    const std::int64_t a = corner[0], b = corner[1], c = corner[2];
    if (this->area(a, b, v) + this->area(b, c, v) + this->area(c, a, v) <
        (1 + Same) * this->area(a, b, c))
    {
      this->plain.corners[3 * t + 2] = v;
      this->plain.corners.insert(this->plain.corners.end(), { b, c, v, c, a, v });
    }
  }
  double area(std::int64_t a, std::int64_t b, std::int64_t c) const
  {
    const double* const p = this->plain.positions.data();
    const Vector normal = cross(difference(p + 3 * b, p + 3 * a), difference(p + 3 * c, p + 3 * a));
    return std::sqrt(dot(normal, normal));
  }
};

} // namespace smg::testing
