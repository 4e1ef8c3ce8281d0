// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/PointProjection.h"

#include "Testing/Solver/ProjectionTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace smg::testing
{
namespace
{

using Influence = PointProjection::Influence;

void addAll(PointProjection& projection, const StreamMesh& mesh, std::int64_t blockCells)
{
  MemorySource source(mesh, blockCells);
  MeshBlock block;
  while (source.next(block))
  {
    projection.add(block);
  }
}

PointProjection projected(const StreamMesh& mesh, const std::vector<double>& points,
  const Influence& influence = {}, std::int64_t blockCells = 1000,
  std::int64_t memoryLimit = PointProjection::DefaultMemoryLimit)
{
  PointProjection projection(points, influence, mesh.cellType, memoryLimit);
  addAll(projection, mesh, blockCells);
  projection.finish();
  return projection;
}

/** Points near vertices all over the mesh, moved away by up to `away`. */
std::vector<double> pointsNear(const StreamMesh& mesh, int count, double away)
{
  Random random(7);
  std::vector<double> points;
  for (int i = 0; i < count; ++i)
  {
    const auto near = pointOf(mesh.positions, random.below(mesh.vertices()));
    for (const double coordinate : near)
    {
      points.push_back(coordinate + random.uniform(-away, away));
    }
  }
  return points;
}

/** The nearest vertex by brute force. */
std::int64_t nearestOf(const StreamMesh& mesh, std::span<const double, 3> point)
{
  std::int64_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double squared = PointTree::squaredDistance(pointOf(mesh.positions, v), point);
    if (squared < least)
    {
      least = squared;
      nearest = v;
    }
  }
  return nearest;
}

/** The point that influences each vertex, by brute force. */
std::vector<std::int64_t> influencesOf(
  const StreamMesh& mesh, const std::vector<std::int64_t>& nearest, const Influence& influence)
{
  std::vector<Indices> rings;
  for (const std::int64_t vertex : nearest)
  {
    rings.push_back(ringsOf(mesh, vertex, influence.rings));
  }
  std::vector<std::int64_t> influences;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    std::int64_t best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < nearest.size(); ++p)
    {
      const double squared =
        PointTree::squaredDistance(pointOf(mesh.positions, nearest[p]), pointOf(mesh.positions, v));
      const bool isIn = squared <= influence.radius * influence.radius || rings[p].count(v) != 0;
      if (isIn && squared < least)
      {
        least = squared;
        best = static_cast<std::int64_t>(p);
      }
    }
    influences.push_back(best);
  }
  return influences;
}

void expectRight(const StreamMesh& mesh, const std::vector<double>& points,
  const Influence& influence, std::int64_t blockCells)
{
  const PointProjection projection = projected(mesh, points, influence, blockCells);
  std::vector<std::int64_t> nearest;
  for (std::size_t p = 0; p < points.size() / 3; ++p)
  {
    const auto point = pointOf(points, static_cast<std::int64_t>(p));
    const auto& found = projection.projected()[p];
    nearest.push_back(nearestOf(mesh, point));
    ASSERT_EQ(found.vertex, nearest.back());
    const auto position = pointOf(mesh.positions, nearest.back());
    EXPECT_TRUE(std::equal(position.begin(), position.end(), found.position.begin()));
    EXPECT_EQ(found.distance, std::sqrt(PointTree::squaredDistance(position, point)));
  }
  const std::vector<std::int64_t> expected = influencesOf(mesh, nearest, influence);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    ASSERT_EQ(projection.influencing(v, pointOf(mesh.positions, v)), expected[v]) << v;
  }
}

TEST(PointProjection, FindsNearestVerticesAndTheirSurroundings)
{
  const StreamMesh surface = toStream(torus(60, 30, 0.2));
  const StreamMesh volume = toStream(tetBox(8, 9, 10, 0.1));
  for (const StreamMesh* mesh : { &surface, &volume })
  {
    const std::vector<double> points = pointsNear(*mesh, 12, 0.3);
    for (const Influence influence :
      { Influence{}, Influence{ 0.4, 0 }, Influence{ 0.0, 1 }, Influence{ 0.3, 3 } })
    {
      for (const std::int64_t blockCells : { 1, 97, 1 << 20 })
      {
        expectRight(*mesh, points, influence, blockCells);
      }
    }
  }
}

TEST(PointProjection, FindsRingsThroughWindowsThatForget)
{
  // Larger than a batch of compared vertices, so that old cells are discarded; the whole mesh would
  // take 20 MiB.
  const StreamMesh mesh = toStream(torus(1000, 150, 0.2));
  const std::vector<double> points = pointsNear(mesh, 40, 0.1);
  const PointProjection whole = projected(mesh, points, { 0.0, 3 }, mesh.cells());
  const PointProjection parts = projected(mesh, points, { 0.0, 3 }, 5000, 1 << 20);
  std::int64_t influenced = 0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const auto position = pointOf(mesh.positions, v);
    const std::int64_t by = whole.influencing(v, position);
    ASSERT_EQ(parts.influencing(v, position), by);
    influenced += by >= 0;
  }
  // 1 + 6 + 12 + 18 in a mesh of six triangles per vertex without overlapping rings.
  EXPECT_LE(influenced, 40 * 37);
  EXPECT_GE(influenced, 40 * 30);
  for (std::size_t p = 0; p < 40; ++p)
  {
    const Indices ring = ringsOf(mesh, whole.projected()[p].vertex, 3);
    EXPECT_EQ(ring.size(), 37U);
    for (const std::int64_t v : ring)
    {
      EXPECT_GE(parts.influencing(v, pointOf(mesh.positions, v)), 0);
    }
  }
}

TEST(PointProjection, TakesTheFirstOfEquallyNearOnes)
{
  const IndexedTestMesh square = grid(2, 2);
  const StreamMesh mesh = toStream(disjointUnion(square, square));
  // Each position has two vertices, the second one in the other square.
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const auto place = pointOf(mesh.positions, v);
    const std::vector<double> points(place.begin(), place.end());
    const PointProjection projection = projected(mesh, points, {}, 1);
    EXPECT_EQ(projection.projected()[0].vertex, v % 4);
    EXPECT_EQ(projection.projected()[0].distance, 0.0);
    // Vertices at the same position are treated alike.
    EXPECT_EQ(projection.influencing((v + 4) % 8, place), 0);
  }
  // Of two points at the same vertex, the first one counts.
  const auto place = pointOf(mesh.positions, 0);
  std::vector<double> points(place.begin(), place.end());
  points.insert(points.end(), place.begin(), place.end());
  EXPECT_EQ(projected(mesh, points).influencing(0, place), 0);
}

TEST(PointProjection, TellsWhichPointsAreFar)
{
  const StreamMesh mesh = toStream(sphere(3));
  const std::vector<double> points{ 1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.03 };
  const PointProjection projection = projected(mesh, points);
  const double diagonal = projection.diagonal();
  EXPECT_NEAR(diagonal, 2.0 * std::sqrt(3.0), 0.05);
  EXPECT_EQ(projection.distantPoints(), std::vector<std::int64_t>{ 1 });
  EXPECT_EQ(projection.distantPoints(0.005), (std::vector<std::int64_t>{ 1, 2 }));
  EXPECT_NEAR(projection.projected()[1].distance, 1.0, 0.01);
}

TEST(PointProjection, KeepsANearestPointForEachVertexOnly)
{
  // Each vertex is in the rings of about twenty points.
  const StreamMesh mesh = toStream(torus(300, 150, 0.2));
  const std::vector<double> points = pointsNear(mesh, 300, 0.01);
  const Influence influence{ 0.0, 30 };
  const auto withLimit = [&](std::int64_t limit)
  {
    PointProjection projection(points, influence, mesh.cellType, limit);
    addAll(projection, mesh, 1000);
    projection.finish();
  };
  // The memory of 45,000 vertices and 90,000 triangles.
  withLimit(std::int64_t(8) << 20);
  const auto tooLittle = [&] { withLimit(std::int64_t(2) << 20); };
  expectError(tooLittle, "30 rings around the 300 points");
  expectError(tooLittle, "2097152 are allowed");
}

TEST(PointProjection, CanBeCancelledAtItsEnd)
{
  const StreamMesh mesh = toStream(torus(300, 150, 0.2));
  for (const int allowed : { 0, 1, 3 })
  {
    PointProjection projection(pointsNear(mesh, 1000, 0.01), { 0.0, 40 }, mesh.cellType);
    addAll(projection, mesh, 1000);
    int calls = 0;
    Progress progress(
      [&](double fraction)
      {
        EXPECT_EQ(fraction, 0.0);
        return ++calls <= allowed;
      });
    EXPECT_THROW(projection.finish(progress), Cancelled) << "after " << allowed << " calls";
  }
}

TEST(PointProjection, RefusesStreamsThatAreNotValid)
{
  const StreamMesh mesh = toStream(grid(20, 20));
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    StreamMesh broken = mesh;
    broken.positions[3 * 17 + 2] = bad;
    expectError([&] { projected(broken, { 0.0, 0.0, 0.0 }); }, "position of vertex 17");
  }
  for (const std::int64_t corner : { std::int64_t(-1), mesh.vertices(), INT64_MAX, INT64_MIN })
  {
    PointProjection projection(std::vector<double>{ 0.0, 0.0, 0.0 }, { 0.0, 2 }, mesh.cellType);
    MeshBlock block;
    block.positions = mesh.positions;
    block.corners = { 0, 1, 2, 1, 2, corner };
    expectError([&] { projection.add(block); }, "cell 1 uses vertex " + std::to_string(corner));
  }
}

TEST(PointProjection, RefusesWhatMakesNoSense)
{
  const std::vector<double> point{ 0.0, 0.0, 0.0 };
  const auto make = [](const std::vector<double>& points, const Influence& influence)
  { return [=] { PointProjection(points, influence, CellType::Triangle); }; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectError(make({ 0.0, 0.0, 0.0, 0.0, nan, 0.0 }, {}), "Point 1");
  expectError(make(point, { nan, 0 }), "radius");
  expectError(make(point, { -1.0, 0 }), "radius");
  expectError(make(point, { 0.0, -1 }), "rings");
  expectError(make(point, { 0.0, PointProjection::MaximumRings + 1 }), "rings");
  PointProjection empty(point, {}, CellType::Triangle);
  expectError([&empty] { empty.finish(); }, "no vertex");
}

} // namespace
} // namespace smg::testing
