// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/Bodies.h"

#include "Solver/Core/DisjointSets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

// Bodies, the connected components of a surface, by union and find over its triangles; the largest
// ones by the diagonals of their bounds. About linear in the triangles, and a sort of the bodies.

namespace smg
{
namespace
{

/** The bodies of a surface as sets of its vertices. */
DisjointSets<std::uint32_t> bodySets(const SurfacePart& part, const Poll& poll)
{
  DisjointSets<std::uint32_t> sets(part.vertices());
  for (std::size_t i = 0; i + 2 < part.corners.size(); i += 3)
  {
    poll.at(i / 3);
    sets.join(part.corners[i], part.corners[i + 1]);
    sets.join(part.corners[i], part.corners[i + 2]);
    for (std::size_t k = i; k < i + 3 && !part.wedges.empty(); ++k)
    {
      sets.join(part.corners[k], part.wedges[k]);
    }
  }
  return sets;
}

constexpr double Infinite = std::numeric_limits<double>::infinity();

struct Body
{
  std::array<double, 3> low{ Infinite, Infinite, Infinite },
    high{ -Infinite, -Infinite, -Infinite };
  std::size_t triangles = 0;
  std::int64_t vertices = 0;
  bool isComplete = true;

  double squaredDiagonal() const
  {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double side = this->high[axis] - this->low[axis];
      sum += side * side;
    }
    return sum;
  }
};

/** The bodies, each at the place of the first of its vertices. */
std::vector<Body> bodiesOf(const SurfacePart& part, std::span<const std::uint8_t> locked,
  DisjointSets<std::uint32_t>& sets, const Poll& poll)
{
  std::vector<Body> bodies;
  poll.resize(bodies, part.vertices());
  for (std::uint32_t v = 0; v < part.vertices(); ++v)
  {
    poll.at(v);
    Body& body = bodies[sets.first(v)];
    ++body.vertices;
    // A body with a locked vertex may go on elsewhere.
    body.isComplete = body.isComplete && locked[v] == 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double x = part.points[3 * std::size_t(v) + axis];
      body.low[axis] = std::min(body.low[axis], x);
      body.high[axis] = std::max(body.high[axis], x);
    }
  }
  for (std::size_t i = 0; i < part.corners.size(); i += 3)
  {
    poll.at(i / 3);
    ++bodies[sets.first(part.corners[i])].triangles;
  }
  return bodies;
}

} // namespace

SmallBodies smallBodies(const SurfacePart& part, std::span<const std::uint8_t> locked,
  std::int64_t vertices, bool mayBeFragments, const Poll& poll)
{
  DisjointSets<std::uint32_t> sets = bodySets(part, poll);
  const std::vector<Body> bodies = bodiesOf(part, locked, sets, poll);
  std::vector<std::pair<double, std::uint32_t>> complete;
  for (std::uint32_t v = 0; v < bodies.size(); ++v)
  {
    poll.at(v);
    if (sets.first(v) == v && bodies[v].isComplete)
    {
      // Negative, so that the largest come first; ties go to the first vertex.
      complete.emplace_back(-bodies[v].squaredDiagonal(), v);
    }
  }
  std::ranges::sort(complete);
  std::size_t most = 0;
  for (std::int64_t needed = 0; most < complete.size(); ++most)
  {
    needed += std::min(bodies[complete[most].second].vertices, VerticesOfBody);
    if (needed > vertices && most > 0)
    {
      break;
    }
  }
  if (most == complete.size())
  {
    return {};
  }
  std::vector<std::uint8_t> drops(part.vertices(), 0);
  for (std::size_t k = most; k < complete.size(); ++k)
  {
    drops[complete[k].second] = 1;
  }
  constexpr std::size_t OfFragment = 3; // less than a closed body has
  std::size_t triangles = 0;
  for (const auto& [size, body] : complete)
  {
    triangles += bodies[body].triangles;
  }
  // A closed body has at least four triangles. Bodies with three or fewer on average are the
  // triangles of one surface that do not share their vertices: to drop any would tear holes.
  if (mayBeFragments && triangles <= OfFragment * complete.size())
  {
    return { 0, {}, true };
  }
  SmallBodies small{ complete.size() - most, {}, false };
  poll.resize(small.hasTriangle, part.triangles());
  for (std::size_t t = 0; t < part.triangles(); ++t)
  {
    poll.at(t);
    small.hasTriangle[t] = drops[sets.first(part.corners[3 * t])];
  }
  return small;
}

void removeBodies(SurfacePart& part, const SmallBodies& bodies, const Poll& poll)
{
  if (bodies.number > 0)
  {
    part.removeTriangles([&](std::size_t t) { return bodies.hasTriangle[t] != 0; }, poll);
    part.dropUnusedVertices(poll);
  }
}

} // namespace smg
