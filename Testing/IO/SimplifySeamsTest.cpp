// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/SimplifyFixture.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"
#include "Testing/Support/Unwelded.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// The law of seams: whatever a surface is cut into, its simplification, welded again, has no
// boundary where the surface had none, unless a note says so; and every triangle has the vertices
// of its own side.

namespace smg::testing
{
namespace
{

using Place = std::array<double, 3>;

Place placeOf(const std::vector<double>& positions, std::int64_t vertex)
{
  const auto at = positions.begin() + 3 * static_cast<std::ptrdiff_t>(vertex);
  return { at[0], at[1], at[2] };
}

/** A mesh whose corners have vertices of their own for each side, by the triangle and its corner.
 */
IndexedTestMesh cut(const IndexedTestMesh& whole,
  const std::function<int(std::size_t triangle, std::int64_t vertex)>& sideOf)
{
  IndexedTestMesh apart{ whole.cellType, {}, {} };
  std::map<std::pair<std::int64_t, int>, std::int64_t> vertices;
  for (std::size_t i = 0; i < whole.corners.size(); ++i)
  {
    const std::int64_t vertex = whole.corners[i];
    const auto [own, isNew] =
      vertices.try_emplace({ vertex, sideOf(i / 3, vertex) }, apart.vertices());
    if (isNew)
    {
      const Place place = placeOf(whole.positions, vertex);
      apart.positions.insert(apart.positions.end(), place.begin(), place.end());
    }
    apart.corners.push_back(own->second);
  }
  return apart;
}

/** For each triangle the nearest of so many random points of the surface. */
std::vector<int> charts(const IndexedTestMesh& mesh, int number, std::uint64_t seed)
{
  const auto middleOf = [&](std::size_t t)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
    {
      sum += Eigen::Map<const Eigen::Vector3d>(
        &mesh.positions[3 * static_cast<std::size_t>(mesh.corners[3 * t + k])]);
    }
    return Eigen::Vector3d(sum / 3.0);
  };
  Random random(seed);
  std::vector<Eigen::Vector3d> seeds;
  for (int k = 0; k < number; ++k)
  {
    seeds.push_back(middleOf(static_cast<std::size_t>(random.below(mesh.cells()))));
  }
  std::vector<int> chart;
  for (std::size_t t = 0; t < static_cast<std::size_t>(mesh.cells()); ++t)
  {
    const Eigen::Vector3d middle = middleOf(t);
    chart.push_back(static_cast<int>(std::ranges::min_element(seeds, {},
                                       [&](const auto& seed) { return (seed - middle).norm(); }) -
                                     seeds.begin()));
  }
  return chart;
}

IndexedTestMesh cutIntoCharts(const IndexedTestMesh& mesh, int number, std::uint64_t seed)
{
  const std::vector<int> chart = charts(mesh, number, seed);
  return cut(mesh, [&](std::size_t t, std::int64_t) { return chart[t]; });
}

/** A torus cut open along both circles: one patch, which meets itself along its seams. */
IndexedTestMesh openedTorus(int nu, int nv)
{
  const IndexedTestMesh whole = torus(nu, nv, 0.2);
  return cut(whole,
    [&](std::size_t t, std::int64_t vertex)
    {
      bool isLastU = false, isLastV = false;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int64_t corner = whole.corners[3 * t + k];
        isLastU = isLastU || corner / nv == nu - 1;
        isLastV = isLastV || corner % nv == nv - 1;
      }
      return (vertex / nv == 0 && isLastU ? 1 : 0) + (vertex % nv == 0 && isLastV ? 2 : 0);
    });
}

/** What a surface is when the vertices at each place are one. */
struct Welded
{
  std::set<Place> boundary; ///< the ends of edges of one triangle
  std::int64_t boundaryEdges = 0;
  double area = 0.0, volume = 0.0;
};

Welded welded(const std::vector<double>& positions, const std::vector<std::int64_t>& corners)
{
  Welded result;
  std::map<std::pair<Place, Place>, int> uses;
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    const std::array<Place, 3> at{ placeOf(positions, corners[i]),
      placeOf(positions, corners[i + 1]), placeOf(positions, corners[i + 2]) };
    for (std::size_t k = 0; k < 3; ++k)
    {
      ++uses[std::minmax(at[k], at[(k + 1) % 3])];
    }
    const Eigen::Vector3d a(at[0].data()), b(at[1].data()), c(at[2].data());
    result.area += 0.5 * (b - a).cross(c - a).norm();
    result.volume += a.dot(b.cross(c)) / 6.0;
  }
  for (const auto& [edge, number] : uses)
  {
    if (number == 1 && edge.first != edge.second)
    {
      ++result.boundaryEdges;
      result.boundary.insert({ edge.first, edge.second });
    }
  }
  return result;
}

struct Cut
{
  std::string name;
  IndexedTestMesh mesh;
  bool isClosed = true;
};

std::vector<Cut> cuts()
{
  IndexedTestMesh plate = grid(200, 120, 0.1);
  for (std::size_t i = 0; i < plate.positions.size(); i += 3)
  {
    plate.positions[i + 2] =
      3.0 * std::sin(0.09 * plate.positions[i]) * std::cos(0.07 * plate.positions[i + 1]);
  }
  return { { "torus in two", cutIntoCharts(torus(200, 120, 0.2), 2, 1) },
    { "torus in 30", cutIntoCharts(torus(200, 120, 0.2), 30, 2) },
    { "torus in 250", cutIntoCharts(torus(200, 120, 0.2), 250, 3) },
    { "opened torus", openedTorus(200, 120) }, { "ball in 12", cutIntoCharts(sphere(6), 12, 4) },
    { "plate in 25", cutIntoCharts(plate, 25, 5), false } };
}

class SimplifySeams : public SimplifyFixture
{
};

} // namespace

TEST_F(SimplifySeams, StayClosed)
{
  Combinations chosen;
  for (const auto& [name, indexed, isClosed] : cuts())
  {
    const StreamMesh mesh = toStream(shuffled(indexed));
    const Welded before = welded(mesh.positions, mesh.corners);
    ASSERT_EQ(before.boundaryEdges == 0, isClosed) << name;
    for (const std::int64_t memory : { 256, 16 })
    {
      for (const SimplifyTarget& target : { SimplifyTarget{ 400, 0.0 }, SimplifyTarget{ 1500, 0.0 },
             SimplifyTarget{ 7000, 0.0 }, SimplifyTarget{ 0, 0.02 } })
      {
        if (!chosen.next())
        {
          continue;
        }
        SCOPED_TRACE(name + " to " + std::to_string(target.vertices) + " in " +
                     std::to_string(memory) + " MiB");
        const StreamMesh simple = this->simplified(mesh, target, memory);
        EXPECT_LT(simple.vertices(), mesh.vertices() / 2);
        EXPECT_FALSE(this->isSaid("a crack may open"));
        if (this->Report.merged_vertices > 0)
        {
          continue;
        }
        const Welded after = welded(simple.positions, simple.corners);
        for (const Place& place : after.boundary)
        {
          EXPECT_TRUE(before.boundary.contains(place)) << place[0] << ' ' << place[1];
        }
        const bool isCoarse =
          target.vertices == 400 || this->isSaid("with the columns of one side");
        EXPECT_NEAR(after.area, before.area, (isCoarse ? 0.15 : 0.05) * before.area);
        if (isClosed)
        {
          EXPECT_EQ(after.boundaryEdges, 0);
          EXPECT_NEAR(after.volume, before.volume, (isCoarse ? 0.15 : 0.05) * before.volume);
        }
        EXPECT_EQ(this->Report.dropped_bodies, 0);
      }
    }
  }
}

/** The points of a seam go as others do: few are left where few are asked for. */
TEST_F(SimplifySeams, AreSimplifiedOnBothSides)
{
  const StreamMesh mesh = toStream(shuffled(cutIntoCharts(torus(200, 120, 0.2), 30, 2)));
  for (const std::int64_t memory : { 256, 16 })
  {
    const StreamMesh simple = this->simplified(mesh, { .vertices = 1500 }, memory);
    EXPECT_LE(simple.vertices(), 1500);
    EXPECT_GT(simple.vertices(), 1480);
    EXPECT_TRUE(this->Report.notes.empty());
  }
}

TEST_F(SimplifySeams, EachSideKeepsItsOwnVertices)
{
  const IndexedTestMesh whole = torus(200, 120, 0.2);
  const std::vector<int> chart = charts(whole, 40, 7);
  const IndexedTestMesh apart = cut(whole, [&](std::size_t t, std::int64_t) { return chart[t]; });
  std::vector<double> chartOf(static_cast<std::size_t>(apart.vertices()));
  for (std::size_t i = 0; i < apart.corners.size(); ++i)
  {
    chartOf[static_cast<std::size_t>(apart.corners[i])] = chart[i / 3];
  }
  StreamMesh mesh = toStream(apart);
  std::vector<double> ofCells, ofVertices;
  for (const std::int64_t vertex : mesh.originalIds)
  {
    ofVertices.push_back(chartOf[static_cast<std::size_t>(vertex)]);
  }
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    ofCells.push_back(ofVertices[static_cast<std::size_t>(mesh.corners[i])]);
  }
  mesh.vertexColumns = { makeColumn<double>("Chart", ofVertices) };
  mesh.cellColumns = { makeColumn<double>("Chart", ofCells) };
  for (const std::int64_t memory : { 256, 16 })
  {
    for (const int threads : { 1, 3 })
    {
      const StreamMesh simple = this->simplified(
        mesh, { .vertices = 1500 }, { .memoryLimit = memory << 20, .threads = threads });
      for (std::size_t i = 0; i < simple.corners.size(); ++i)
      {
        ASSERT_EQ(simple.vertexColumns[0].value(static_cast<std::size_t>(simple.corners[i])),
          simple.cellColumns[0].value(i / 3));
      }
      EXPECT_EQ(welded(simple.positions, simple.corners).boundaryEdges, 0);
    }
  }
}

TEST_F(SimplifySeams, DoNotDependOnThreads)
{
  const StreamMesh mesh = toStream(shuffled(cutIntoCharts(torus(200, 120, 0.2), 30, 2)));
  const auto with = [&](int threads)
  {
    return this->simplified(
      mesh, { .vertices = 7000 }, { .memoryLimit = std::int64_t(16) << 20, .threads = threads });
  };
  const StreamMesh one = with(1), several = with(3);
  EXPECT_EQ(one.corners, several.corners);
  EXPECT_EQ(one.positions, several.positions);
}

/** Held points, labels and seams together. */
TEST_F(SimplifySeams, GoWithWhatIsHeldAndWithLabels)
{
  StreamMesh mesh = toStream(shuffled(cutIntoCharts(torus(200, 120, 0.2), 30, 2)));
  std::vector<std::int32_t> labels;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    labels.push_back(placeOf(mesh.positions, mesh.corners[i])[2] > 0.1 ? 1 : 0);
  }
  mesh.cellColumns = { makeColumn<std::int32_t>("Label", labels) };
  for (const std::int64_t memory : { 256, 16 })
  {
    const StreamMesh simple = this->simplified(mesh, { .vertices = 2500 },
      { .hold = { smg::sphere({ 3.0, 0.0, 0.0 }, 0.4) }, .memoryLimit = memory << 20 });
    EXPECT_LE(simple.vertices(), 2500);
    EXPECT_TRUE(this->Report.notes.empty());
    EXPECT_EQ(welded(simple.positions, simple.corners).boundaryEdges, 0);
  }
}

/** One side of a place may be held alone, whichever has the smaller number. */
TEST_F(SimplifySeams, OneSideMayBeHeld)
{
  // The first vertex of the stream, which has several vertices at its place.
  IndexedTestMesh opened = openedTorus(100, 60);
  std::map<Place, int> vertices;
  for (std::int64_t vertex = 0; vertex < opened.vertices(); ++vertex)
  {
    ++vertices[placeOf(opened.positions, vertex)];
  }
  const auto first = std::ranges::find_if(opened.corners,
    [&](std::int64_t corner) { return vertices[placeOf(opened.positions, corner)] > 1; });
  const auto number = first - opened.corners.begin();
  std::rotate(opened.corners.begin(), first - number % 3, opened.corners.end());
  std::rotate(
    opened.corners.begin(), opened.corners.begin() + number % 3, opened.corners.begin() + 3);
  const StreamMesh mesh = toStream(opened, TestOrder::Keep);
  const Place place = placeOf(mesh.positions, 0);
  int sides = 0;
  for (std::int64_t vertex = 0; vertex < mesh.vertices(); ++vertex)
  {
    if (placeOf(mesh.positions, vertex) != place)
    {
      continue;
    }
    ++sides;
    const StreamMesh simple =
      this->simplified(mesh, { .vertices = 800 }, { .hold = { Region::Vertices{ { vertex } } } });
    EXPECT_EQ(welded(simple.positions, simple.corners).boundaryEdges, 0) << vertex;
    bool isKept = false;
    for (std::int64_t v = 0; v < simple.vertices(); ++v)
    {
      isKept = isKept || placeOf(simple.positions, v) == place;
    }
    EXPECT_TRUE(isKept) << vertex;
  }
  EXPECT_GE(sides, 2);
}

/** Few vertices are not enough for all sides where many patches meet: these are joined, and the
 * result is as near as that of the whole surface. */
TEST_F(SimplifySeams, AreWeldedWhereTheNumberAsksForIt)
{
  const IndexedTestMesh whole = torus(200, 120, 0.2);
  const double volume = welded(whole.positions, whole.corners).volume;
  for (const IndexedTestMesh& mesh : { cutIntoCharts(whole, 250, 3), unwelded(whole) })
  {
    for (const std::int64_t vertices : { 4, 30, 100, 500 })
    {
      SCOPED_TRACE(vertices);
      const StreamMesh simple =
        this->simplified(toStream(shuffled(mesh)), { .vertices = vertices });
      EXPECT_LE(simple.vertices(), vertices);
      EXPECT_GT(simple.vertices(), vertices - 20);
      EXPECT_TRUE(this->isSaid("with the columns of one side"));
      EXPECT_EQ(this->Report.merged_vertices, 0);
      const Welded after = welded(simple.positions, simple.corners);
      EXPECT_EQ(after.boundaryEdges, 0);
      if (vertices >= 100)
      {
        EXPECT_NEAR(after.volume, volume, (vertices == 100 ? 0.3 : 0.1) * volume);
      }
    }
  }
}

/** No more of them than the number asks for. */
TEST_F(SimplifySeams, AreWeldedNoMoreThanTheNumberAsksFor)
{
  const StreamMesh mesh = toStream(shuffled(unwelded(torus(60, 40, 0.2))));
  for (const std::int64_t vertices : { 100, 2400, 3000, 5000, 14000, 14400, 14500 })
  {
    for (const std::int64_t memory : { 256, 16 })
    {
      SCOPED_TRACE(vertices);
      const StreamMesh simple = this->simplified(mesh, { .vertices = vertices }, memory);
      EXPECT_LE(simple.vertices(), vertices);
      EXPECT_GT(simple.vertices(), std::min(mesh.vertices(), vertices) - 20);
    }
  }
}

/** Of more seams than the memory has room for, the number of places is said. */
TEST_F(SimplifySeams, AreGivenUpForTheMemoryWhichIsSaid)
{
  const IndexedTestMesh whole = torus(600, 300);
  const auto patch = [](std::size_t t, std::int64_t)
  { return static_cast<int>(t / 2 / 300 / 4 * 1000 + t / 2 % 300 / 4); };
  const StreamMesh mesh = toStream(cut(whole, patch));
  this->simplified(mesh, { .error = 0.01 }, 16);
  EXPECT_TRUE(this->isSaid("Points of the boundary coincide at about "));
  EXPECT_TRUE(this->isSaid("a crack may open"));
  EXPECT_TRUE(this->isSaid("--weld 0"));
  this->simplified(mesh, { .error = 0.01 }, 256);
  EXPECT_FALSE(this->isSaid("a crack may open"));
}

TEST_F(SimplifySeams, AreOnlyOfBoundaries)
{
  for (const std::int64_t memory : { 256, 16 })
  {
    for (const IndexedTestMesh& mesh : { torus(200, 120), grid(200, 120),
           // Closed bodies at the same place have no boundary.
           disjointUnion(sphere(5), sphere(5)) })
    {
      this->simplified(toStream(mesh), { .vertices = 2000 }, memory);
      EXPECT_TRUE(this->Report.notes.empty());
    }
  }
}

} // namespace smg::testing
