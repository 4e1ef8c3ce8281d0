// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/DisjointSets.h"
#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/TriangleTree.h"

#include "Testing/IO/SimplifyFixture.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <ostream>
#include <set>
#include <span>
#include <utility>
#include <vector>

// The law of surfaces that branch: with an error, sheets at edges of three and more triangles are
// those of the mesh, with their handles and boundary curves, however small they are, and near it;
// edges of three and more triangles stay. With a number of vertices small ones go.

namespace smg::testing
{
namespace
{

using Edge = std::pair<std::int64_t, std::int64_t>;

/** What does not change while the topology stays. */
struct Topology
{
  std::int64_t euler = 0;             ///< vertices - edges + triangles
  std::int64_t branching = 0;         ///< edges of three and more triangles
  std::int64_t loops = 0;             ///< connected parts of the boundary
  std::multiset<std::int64_t> sheets; ///< the Euler characteristic of each
  bool operator==(const Topology&) const = default;
};

void PrintTo(const Topology& topology, std::ostream* to)
{
  *to << "Euler characteristic " << topology.euler << ", " << topology.branching
      << " branching edges, " << topology.loops << " loops, sheets:";
  for (const std::int64_t euler : topology.sheets)
  {
    *to << ' ' << euler;
  }
}

Topology topologyOf(const StreamMesh& mesh)
{
  std::map<Edge, std::vector<std::int64_t>> edges; // with their triangles
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
  {
    edges[std::minmax(mesh.corners[i], mesh.corners[i % 3 == 2 ? i - 2 : i + 1])].push_back(
      static_cast<std::int64_t>(i / 3));
  }
  Topology topology;
  topology.euler = mesh.vertices() - static_cast<std::int64_t>(edges.size()) + mesh.cells();
  DisjointSets<std::int64_t> sheets(static_cast<std::size_t>(mesh.cells())),
    curves(static_cast<std::size_t>(mesh.vertices()));
  std::set<std::int64_t> onCurves;
  for (const auto& [edge, triangles] : edges)
  {
    if (triangles.size() == 1)
    {
      curves.join(edge.first, edge.second);
      onCurves.insert({ edge.first, edge.second });
    }
    else if (triangles.size() == 2)
    {
      sheets.join(triangles[0], triangles[1]);
    }
    topology.branching += triangles.size() > 2 ? 1 : 0;
  }
  std::set<std::int64_t> loops;
  for (const std::int64_t v : onCurves)
  {
    loops.insert(curves.first(v));
  }
  topology.loops = static_cast<std::int64_t>(loops.size());
  std::map<std::int64_t, std::set<std::int64_t>> vertices;
  std::map<std::int64_t, std::int64_t> euler;
  for (std::int64_t t = 0; t < mesh.cells(); ++t)
  {
    const auto corners = mesh.corners.begin() + 3 * t;
    vertices[sheets.first(t)].insert(corners, corners + 3);
    ++euler[sheets.first(t)];
  }
  for (const auto& [edge, triangles] : edges)
  {
    std::set<std::int64_t> of;
    for (const std::int64_t t : triangles)
    {
      of.insert(sheets.first(t));
    }
    for (const std::int64_t sheet : of)
    {
      --euler[sheet];
    }
  }
  for (const auto& [sheet, number] : euler)
  {
    topology.sheets.insert(number + std::ssize(vertices[sheet]));
  }
  return topology;
}

/** The largest distance of some vertices of a mesh from another one. */
double distanceOf(std::span<const double> points, const StreamMesh& from)
{
  double largest = 0.0;
  for (std::size_t v = 0; v < points.size(); v += 3)
  {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < from.corners.size(); i += 3)
    {
      TrianglePoints triangle{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        std::copy_n(
          &from.positions[3 * static_cast<std::size_t>(from.corners[i + k])], 3, triangle.point[k]);
      }
      const Vector way = difference(nearestPoint(triangle, &points[v]).data(), &points[v]);
      least = std::min(least, dot(way, way));
    }
    largest = std::max(largest, least);
  }
  return std::sqrt(largest);
}

/** A wavy plate of nx x ny vertices, in the plane but for `height`. */
IndexedTestMesh plate(int nx, int ny, double height)
{
  IndexedTestMesh mesh = grid(nx, ny);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
  {
    mesh.positions[i + 2] =
      height * std::sin(0.3 * mesh.positions[i]) * std::cos(0.2 * mesh.positions[i + 1]);
  }
  return mesh;
}

/** Adds a sheet of `rows` rows of triangles, whose first row of vertices is `rim`; each next one
 * may have fewer, and is `up` farther. */
void addSheet(IndexedTestMesh& mesh, std::vector<std::int64_t> rim, int rows, bool isNarrow,
  const std::array<double, 3>& up)
{
  for (int row = 0; row < rows && !rim.empty(); ++row)
  {
    std::vector<std::int64_t> next;
    const std::size_t number = isNarrow ? (row + 1 == rows ? 1 : (rim.size() + 1) / 2) : rim.size();
    for (std::size_t k = 0; k < number; ++k)
    {
      const std::int64_t below = rim[number == 1 ? rim.size() / 2 : k * rim.size() / number];
      next.push_back(mesh.vertices());
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        mesh.positions.push_back(
          mesh.positions[3 * static_cast<std::size_t>(below) + axis] + up[axis]);
      }
    }
    for (std::size_t a = 0, b = 0; a + 1 < rim.size() || b + 1 < next.size();)
    {
      const bool isBelow = b + 1 == next.size() ||
                           (a + 1 < rim.size() && (a + 1) * next.size() <= (b + 1) * rim.size());
      mesh.corners.insert(
        mesh.corners.end(), { rim[a], isBelow ? rim[a + 1] : next[b + 1], next[b] });
      ++(isBelow ? a : b);
    }
    rim = std::move(next);
  }
}

/** Adds fins of one triangle and sheets of several at random rows of edges; books, where they meet
 * at one. */
void addSheets(IndexedTestMesh& mesh, int nx, int ny, std::int64_t number, Random& random)
{
  for (std::int64_t k = 0; k < number; ++k)
  {
    const std::int64_t length = 2 + (random.below(2) == 0 ? 0 : random.below(nx - 2));
    const std::int64_t first = random.below(nx - length + 1) + nx * random.below(ny);
    std::vector<std::int64_t> rim;
    for (std::int64_t v = first; v < first + length; ++v)
    {
      rim.push_back(v);
    }
    const int rows = static_cast<int>(1 + random.below(3));
    const bool isNarrow = random.below(2) == 0;
    const double height = random.uniform(0.3, 12.0) / rows;
    for (std::int64_t pages = 1 + random.below(2); pages > 0; --pages)
    {
      addSheet(mesh, rim, rows, isNarrow,
        { random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), pages == 1 ? height : -height });
    }
  }
}

class SimplifySheets : public SimplifyFixture
{
};

} // namespace

TEST_F(SimplifySheets, AnErrorKeepsThemAll)
{
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int nx = static_cast<int>(8 + random.below(20)),
              ny = static_cast<int>(8 + random.below(20));
    IndexedTestMesh all = plate(nx, ny, random.below(2) == 0 ? 0.0 : 1.0);
    addSheets(all, nx, ny, 1 + random.below(4), random);
    const StreamMesh mesh = toStream(shuffled(all, seed));
    const double error = std::pow(10.0, random.uniform(-2.0, 0.5));
    for (const std::int64_t vertices : { 0, 4 })
    {
      const StreamMesh simple =
        this->simplified(mesh, { .vertices = vertices, .error = error }, 256);
      EXPECT_EQ(topologyOf(simple), topologyOf(mesh));
      // The error is a mean of the squares of distances from planes.
      constexpr double Far = 6.0;
      EXPECT_LT(distanceOf(mesh.positions, simple), Far * error);
      EXPECT_LE(this->Report.error, error);
    }
  }
}

/** Parts and windows of little memory are simplified with vertices that others have. No fin is at
 * the rim of the plate, where it would be a part of it. */
TEST_F(SimplifySheets, AnErrorKeepsThemInParts)
{
  constexpr int Wide = 220, High = 150;
  for (const double error : { 0.1, 2.0 })
  {
    Random random(7);
    IndexedTestMesh all = plate(Wide, High, 1.0);
    const auto ofPlate = static_cast<std::ptrdiff_t>(all.positions.size());
    for (int k = 0; k < 300; ++k)
    {
      const std::int64_t first = random.below(Wide - 1) + Wide * (1 + random.below(High - 2));
      addSheet(all, { first, first + 1 }, 1, true, { 0.2, 0.1, random.uniform(8.0, 12.0) });
    }
    const StreamMesh mesh = toStream(all);
    const StreamMesh simple = this->simplified(mesh, { .error = error }, 16);
    EXPECT_LT(simple.vertices(), mesh.vertices() / 2);
    EXPECT_EQ(topologyOf(simple), topologyOf(mesh));
    EXPECT_LT(distanceOf(std::span(all.positions).subspan(ofPlate), simple), error);
  }
}

/** Planes do not see how long a spike of the boundary is that is narrower than the error. */
TEST_F(SimplifySheets, AnErrorKeepsSpikesOfTheBoundary)
{
  for (const double error : { 0.1, 1.0, 2.0, 4.0 })
  {
    const StreamMesh mesh = toStream(gridWithNeedle(20, 20, 50.0));
    const StreamMesh simple = this->simplified(mesh, { .error = error }, 256);
    EXPECT_EQ(topologyOf(simple), topologyOf(mesh));
    constexpr double Far = 4.0;
    EXPECT_LT(distanceOf(mesh.positions, simple), Far * error);
  }
}

TEST_F(SimplifySheets, ANumberOfVerticesKeepsThoseLargerThanItsErrors)
{
  for (const double height : { 0.05, 12.0 })
  {
    IndexedTestMesh all = plate(30, 30, 1.0);
    const std::int64_t first = 30 * 15 + 14;
    addSheet(all, { first, first + 1 }, 1, true, { 0, 0, height });
    const StreamMesh mesh = toStream(all);
    const StreamMesh few = this->simplified(mesh, { .vertices = 20 });
    EXPECT_EQ(few.vertices(), 20);
    EXPECT_EQ(topologyOf(few).loops, height < 1.0 ? 1 : 2);
    // Where the number cannot be reached otherwise, the report says how large the sheet was.
    EXPECT_EQ(this->simplified(mesh, { .vertices = 5 }).vertices(), 5);
    EXPECT_GE(this->Report.error, height);
  }
}

} // namespace smg::testing
