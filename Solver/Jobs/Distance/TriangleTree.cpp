// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/TriangleTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

// A balanced tree of bounding boxes, in an array: a node is followed by its first child and all
// nodes below that. Boxes are single precision, which saves memory, and rounded outwards, so that
// their distances are lower bounds. A search visits the nearer child first and skips boxes that are
// farther than the best triangle so far.
//
// Only boxes that are farther for certain, by more than rounding, are skipped, and of equally near
// triangles the one with the lowest number counts. So the answer is the same, to the last bit, as
// if all triangles were compared in their order, whatever the shape of the tree and the guess.
// Building takes about n log n steps.

namespace smg
{

namespace
{

/** The point a + way * part / whole, on an edge from a; a itself if the edge has no length. */
Vector pointBetween(const double* a, const Vector& way, double part, double whole)
{
  const double share = whole > 0 ? part / whole : 0;
  return { a[0] + share * way[0], a[1] + share * way[1], a[2] + share * way[2] };
}

/** Three times a coordinate of the centre, which is only compared. */
double centreOf(const TrianglePoints& triangle, int axis)
{
  return triangle.point[0][axis] + triangle.point[1][axis] + triangle.point[2][axis];
}

} // namespace

Vector nearestPoint(const TrianglePoints& triangle, const double* point)
{
  const auto& [a, b, c] = triangle.point;
  const Vector ab = difference(b, a), ac = difference(c, a), ap = difference(point, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  // In the region of corner a. Names are taken from the book: d1 to d6 are products with the edges
  // ab and ac, and va, vb, vc the barycentric coordinates of the projection, times the square of
  // twice the area.
  if (d1 <= 0 && d2 <= 0)
  {
    return { a[0], a[1], a[2] };
  }
  const Vector bp = difference(point, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  // Of corner b.
  if (d3 >= 0 && d4 <= d3)
  {
    return { b[0], b[1], b[2] };
  }
  const double vc = d1 * d4 - d3 * d2;
  // Of the edge ab.
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
  {
    return pointBetween(a, ab, d1, d1 - d3);
  }
  const Vector cp = difference(point, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  // Of corner c.
  if (d6 >= 0 && d5 <= d6)
  {
    return { c[0], c[1], c[2] };
  }
  const double vb = d5 * d2 - d1 * d6;
  // Of the edge ac.
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
  {
    return pointBetween(a, ac, d2, d2 - d6);
  }
  const double va = d3 * d6 - d5 * d4;
  // Of the edge bc.
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
  {
    return pointBetween(b, difference(c, b), d4 - d3, (d4 - d3) + (d5 - d6));
  }
  // Inside.
  const double share = 1 / (va + vb + vc);
  Vector nearest{};
  for (int k = 0; k < 3; ++k)
  {
    nearest[k] = a[k] + ab[k] * (vb * share) + ac[k] * (vc * share);
  }
  return nearest;
}

TriangleTree::TriangleTree(Pool& pool, std::span<const TrianglePoints> triangles)
  : Triangles(triangles)
  , OrderMemory(pool, triangles.size() * sizeof(std::uint32_t))
  , NodeMemory(
      pool, static_cast<std::size_t>(nodesFor(static_cast<std::int64_t>(triangles.size()))) *
              sizeof(Node))
  , Order(reinterpret_cast<std::uint32_t*>(this->OrderMemory.data()), triangles.size())
  , Nodes(reinterpret_cast<Node*>(this->NodeMemory.data()))
{
  std::iota(this->Order.begin(), this->Order.end(), 0U);
  if (!triangles.empty())
  {
    this->build(0, static_cast<std::uint32_t>(triangles.size()));
  }
}

/** An upper bound of the number of nodes: each leaf has at least half of LeafTriangles, unless it
 * is the only one, and a tree has fewer than twice as many nodes as leaves. */
std::int64_t TriangleTree::nodesFor(std::int64_t triangles)
{
  return std::max<std::int64_t>(1, 2 * triangles / (LeafTriangles / 2));
}

/** Builds the tree of the triangles Order[begin, end), and returns its root. */
std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end)
{
  const std::uint32_t node = this->NodeCount++;
  this->enclose(this->Nodes[node], begin, end);
  this->Nodes[node].first = begin;
  this->Nodes[node].count = end - begin;
  if (end - begin > LeafTriangles)
  {
    const std::uint32_t middle = begin + (end - begin) / 2;
    this->split(begin, middle, end);
    // The first child gets the next number, so only the second one is stored.
    this->build(begin, middle);
    this->Nodes[node].first = this->build(middle, end);
    this->Nodes[node].count = 0;
  }
  return node;
}

/** Halves the triangles in number, which keeps the tree balanced, along the axis in which their
 * centres extend farthest. */
void TriangleTree::split(std::uint32_t begin, std::uint32_t middle, std::uint32_t end)
{
  std::array<double, 3> extent{};
  for (int k = 0; k < 3; ++k)
  {
    const auto [low, high] = std::ranges::minmax(this->Order.subspan(begin, end - begin), {},
      [&](std::uint32_t t) { return centreOf(this->Triangles[t], k); });
    extent[k] = centreOf(this->Triangles[high], k) - centreOf(this->Triangles[low], k);
  }
  const auto axis = static_cast<int>(std::ranges::max_element(extent) - extent.begin());
  // Ties are broken by number, so that the halves do not depend on the order before.
  std::nth_element(this->Order.begin() + begin, this->Order.begin() + middle,
    this->Order.begin() + end,
    [&](std::uint32_t s, std::uint32_t t)
    {
      return std::pair(centreOf(this->Triangles[s], axis), s) <
             std::pair(centreOf(this->Triangles[t], axis), t);
    });
}

/** Encloses the corners of the triangles of a node. */
void TriangleTree::enclose(Node& node, std::uint32_t begin, std::uint32_t end) const
{
  constexpr double Infinite = std::numeric_limits<double>::infinity();
  constexpr float Most = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    double low = Infinite, high = -Infinite;
    for (std::uint32_t i = begin; i < end; ++i)
    {
      for (const auto& point : this->Triangles[this->Order[i]].point)
      {
        low = std::min(low, point[k]);
        high = std::max(high, point[k]);
      }
    }
    // Rounded outwards: the nearest float may lie inside.
    node.low[k] = std::nextafter(static_cast<float>(low), -Most);
    node.high[k] = std::nextafter(static_cast<float>(high), Most);
  }
}

/** The squared distance of a point from the box of a node; 0 inside. */
double TriangleTree::squareTo(const Node& node, const double* point)
{
  double square = 0;
  for (int k = 0; k < 3; ++k)
  {
    const double beyond =
      std::max({ double(node.low[k]) - point[k], point[k] - double(node.high[k]), 0.0 });
    square += beyond * beyond;
  }
  return square;
}

auto TriangleTree::nearest(const double* point, double bound, std::int64_t guess) const -> Nearest
{
  // Distances are compared, not their squares, so that a bound from another tree is compared in the
  // same way as a distance of this one: the result does not depend on how triangles are divided
  // among trees.
  Nearest best{ -1, bound };
  constexpr double Rounding = 1.0 + 1e-14;
  // Boxes whose squared distance is above this are farther than the best triangle for certain.
  double most = Rounding * bound * bound;
  const auto offer = [&](std::int64_t triangle)
  {
    const Vector way = difference(
      nearestPoint(this->Triangles[static_cast<std::size_t>(triangle)], point).data(), point);
    const double distance = std::sqrt(dot(way, way));
    if (distance < best.distance || (distance == best.distance && best.triangle > triangle))
    {
      best = { triangle, distance };
      most = Rounding * distance * distance;
    }
  };
  if (guess >= 0)
  {
    offer(guess);
  }
  // The nodes to be visited, on a stack. The tree is balanced and numbers of triangles have 32
  // bits, so its depth is below 32; each level leaves at most one node on the stack.
  std::array<std::uint32_t, 64> open;
  std::size_t count = 0;
  if (this->NodeCount > 0)
  {
    open[count++] = 0;
  }
  while (count > 0)
  {
    const std::uint32_t n = open[--count];
    const Node& node = this->Nodes[n];
    if (squareTo(node, point) > most)
    {
      continue;
    }
    // A leaf.
    if (node.count > 0)
    {
      std::ranges::for_each(this->Order.subspan(node.first, node.count), offer);
      continue;
    }
    // The nearer child first.
    const bool rightFirst =
      squareTo(this->Nodes[node.first], point) < squareTo(this->Nodes[n + 1], point);
    open[count++] = rightFirst ? n + 1 : node.first;
    open[count++] = rightFirst ? node.first : n + 1;
  }
  return best;
}

} // namespace smg
