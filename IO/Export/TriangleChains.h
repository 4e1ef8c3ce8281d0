// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Restores a polygon from its triangles. The polygon c0 c1 c2 ... was split into the fan of
 * triangles c0 c1 c2, c0 c2 c3 ..., which may come in any order: from c1 on, the corners are the
 * trail that uses the last two corners of each triangle once, as an edge. If corners of the polygon
 * are repeated, several polygons may have the same triangles; the result is one of these.
 */
class FanChain
{
public:
  /** Whether the triangles, 3 corners each, are such a fan; then polygon() returns its corners. */
  bool build(std::span<const std::uint32_t> triangles);

  std::span<const std::uint32_t> polygon() const { return this->Corners; }

private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  bool findStart(std::uint32_t& start) const;
  void walk(std::uint32_t start);

  std::vector<std::uint32_t> Corners;
  std::vector<Edge> Edges;                 ///< by their first corner
  std::vector<std::uint32_t> Ends;         ///< the edges' last corners, ascending
  std::vector<std::size_t> Taken;          ///< by the first edge of a corner: how many of its edges
  std::vector<std::uint32_t> Stack, Trail; ///< the trail from its end to its start
};

/**
 * Restores the order of the triangles of a strip. The strip v0 v1 v2 ... was split into the
 * triangles v0 v1 v2, v2 v1 v3, v2 v3 v4, v4 v3 v5 ..., which may come in any order: a b c in an
 * even place is followed by c b d, in an odd place by a c d.
 */
class StripChain
{
public:
  /** Whether the triangles, 3 corners each, are such a strip in one order only, which is then
   * order(). A strip that ends where it begins has several. */
  bool build(std::span<const std::uint32_t> triangles);

  /** The triangles from the first to the last, by their places. */
  std::span<const std::uint32_t> order() const { return this->Order; }

private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  static constexpr std::uint32_t None = UINT32_MAX;

  /** The triangle that follows one in an even or an odd place. */
  std::uint32_t after(std::span<const std::uint32_t> triangle, bool isEven) const;

  std::vector<std::pair<Edge, std::uint32_t>> Begins; ///< the first two corners of each triangle
  std::vector<std::uint32_t> Order;
};

/**
 * Restores a polygon from the triangles of a PolygonTriangulation, which may come in any order. Its
 * triangles have ascending places a b c in the polygon: a c is a side of the triangle before, or
 * the side from the last corner to the first; a b and b c are those of other triangles, or sides
 * of the polygon. If corners of the polygon are repeated, several polygons may have the same
 * triangles; the result is one of these.
 */
class PolygonTree
{
public:
  /** Whether the triangles, 3 corners each, are those of such a polygon; then polygon() returns its
   * corners. */
  bool build(std::span<const std::uint32_t> triangles);

  std::span<const std::uint32_t> polygon() const { return this->Corners; }
  /** The triangles by their places, in an order that does not depend on that in which they came. */
  std::span<const std::uint32_t> order() const { return this->Order; }

private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  static constexpr std::uint32_t None = UINT32_MAX;

  /** Triangles that are tried as root where none must be it. */
  static constexpr std::size_t MostRoots = 64;

  std::size_t findRoots();
  bool unfold(std::span<const std::uint32_t> triangles, std::uint32_t root);
  std::uint32_t take(const Edge& edge);

  std::vector<std::pair<Edge, std::uint32_t>> Bases; ///< first and last corner of each triangle
  std::vector<Edge> Sides;                           ///< the two others
  std::vector<std::size_t> Taken; ///< by the first base of an edge: how many of its triangles
  std::vector<std::uint32_t> Roots, Corners, Order;
  std::vector<Edge> Stack;
};

} // namespace smg
