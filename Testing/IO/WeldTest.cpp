// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Weld.h"

#include "IO/Import/RawMeshBuilder.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace smg::testing
{
namespace
{

using Point = std::array<double, 3>;

class Weld : public ::testing::Test
{
protected:
  /** A mesh of triangles of consecutive points. */
  RawMesh soup(const std::vector<Point>& points)
  {
    RawMeshBuilder builder(this->Space, CellChoice::Only);
    for (const Point& p : points)
    {
      builder.vertex(p[0], p[1], p[2]);
    }
    for (std::int64_t i = 0; i + 2 < static_cast<std::int64_t>(points.size()); i += 3)
    {
      builder.triangle(i, i + 1, i + 2);
    }
    return builder.finish();
  }

  TemporaryFolder Folder;
  Workspace Space{ Folder.path(), Workspace::MinMemory };
};

/** The reference result of welding, from comparing all pairs of points. */
std::vector<std::int64_t> expectedVertices(const std::vector<Point>& points, double tolerance)
{
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&points](std::size_t a, std::size_t b)
    { return std::pair(points[a], a) < std::pair(points[b], b); });
  std::vector<std::size_t> kept;
  std::vector<std::int64_t> vertices(points.size());
  for (const std::size_t i : order)
  {
    std::size_t vertex = i;
    for (const std::size_t other : kept)
    {
      const Point& a = points[i];
      const Point& b = points[other];
      if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= tolerance)
      {
        vertex = other;
        break;
      }
    }
    if (vertex == i)
    {
      kept.push_back(i);
    }
    vertices[i] = static_cast<std::int64_t>(vertex);
  }
  return vertices;
}

} // namespace

TEST_F(Weld, RefusesDistancesThatAreNone)
{
  RawMesh mesh = this->soup({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_THROW(weldPoints(mesh, -1e-9, this->Space), Error);
  EXPECT_THROW(weldPoints(mesh, std::numeric_limits<double>::quiet_NaN(), this->Space), Error);
  EXPECT_EQ(weldPoints(mesh, 0, this->Space), 0);
}

TEST_F(Weld, MergesEqualPoints)
{
  std::vector<Point> points;
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i)
  {
    points.push_back({ double(random() % 9), double(random() % 9), i % 2 ? 0.0 : -0.0 });
  }
  RawMesh mesh = this->soup(points);
  EXPECT_EQ(weldPoints(mesh, 0.0, this->Space), 3000 - 81);
  EXPECT_EQ(mesh.counts.mergedPoints, 3000 - 81);
  std::map<Point, std::int64_t> vertexAt;
  const ReadMesh read = readRaw(mesh);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Point place{ points[i][0], points[i][1], 0.0 };
    const auto [entry, fresh] = vertexAt.emplace(place, read.corners[i]);
    EXPECT_EQ(entry->second, read.corners[i]);
  }
  EXPECT_EQ(vertexAt.size(), 81u);
}

TEST_F(Weld, MergesPointsWithinTheTolerance)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  std::vector<Point> points(3000);
  for (Point& p : points)
  {
    p = { coordinate(random), coordinate(random), coordinate(random) };
  }
  RawMesh mesh = this->soup(points);
  const std::vector<std::int64_t> expected = expectedVertices(points, 0.05);
  EXPECT_GT(weldPoints(mesh, 0.05, this->Space), 100);
  EXPECT_EQ(readRaw(mesh).corners, expected);
}

TEST_F(Weld, LeavesDistinctPointsAlone)
{
  RawMesh mesh = this->soup({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_EQ(weldPoints(mesh, 0.5, this->Space), 0);
  EXPECT_EQ(readRaw(mesh).corners, (std::vector<std::int64_t>{ 0, 1, 2 }));
}

} // namespace smg::testing
