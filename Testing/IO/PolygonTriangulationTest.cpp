// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/PolygonTriangulation.h"
#include "IO/Export/TriangleChains.h"

#include "Solver/Core/Vector.h"
#include "Testing/IO/RandomPolygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace smg::testing
{
namespace
{

using Triangle = PolygonTriangulation::Triangle;

PolygonTriangulation cutOf(const std::vector<double>& corners)
{
  PolygonTriangulation cut;
  cut.cut(corners, [] {});
  return cut;
}

Vector areaOf(const std::vector<double>& corners, const Triangle& t)
{
  return scaled(0.5, cross(difference(&corners[3 * t[1]], &corners[3 * t[0]]),
                       difference(&corners[3 * t[2]], &corners[3 * t[0]])));
}

/** The corners of the polygon that the triangles were, in another order; empty if none. */
std::vector<std::uint32_t> restored(std::vector<Triangle> triangles, Random& random)
{
  std::vector<std::uint32_t> corners;
  for (std::size_t left = triangles.size(); left > 0; --left)
  {
    std::swap(triangles[left - 1], triangles[std::size_t(random.below(std::int64_t(left)))]);
    corners.insert(corners.end(), triangles[left - 1].begin(), triangles[left - 1].end());
  }
  PolygonTree tree;
  return tree.build(corners)
           ? std::vector<std::uint32_t>(tree.polygon().begin(), tree.polygon().end())
           : std::vector<std::uint32_t>();
}

TEST(PolygonTriangulation, CoversAPolygonOnceAndGivesItBack)
{
  Random random(1);
  int fans = 0;
  for (int k = 0; k < 4000; ++k)
  {
    SCOPED_TRACE(k);
    const RandomPolygon polygon = randomPolygon(random, k);
    const PolygonTriangulation cut = cutOf(polygon.corners);
    ASSERT_EQ(cut.triangles().size(), polygon.size() - 2);
    EXPECT_FALSE(cut.overlaps());
    fans += cut.isFan() ? 1 : 0;
    // The areas of the triangles, as vectors and as numbers, add up to that of the polygon: all
    // have its orientation.
    Vector sum{};
    double numbers = 0.0;
    for (const Triangle& triangle : cut.triangles())
    {
      EXPECT_TRUE(std::ranges::is_sorted(triangle));
      const Vector area = areaOf(polygon.corners, triangle);
      std::ranges::transform(sum, area, sum.begin(), std::plus<>());
      numbers += std::sqrt(dot(area, area));
    }
    EXPECT_NEAR(numbers, polygon.area, 1e-9 * (1 + polygon.area));
    EXPECT_NEAR(std::sqrt(dot(sum, sum)), polygon.area, 1e-9 * (1 + polygon.area));

    std::vector<std::uint32_t> places(polygon.size());
    std::iota(places.begin(), places.end(), 0);
    EXPECT_EQ(restored({ cut.triangles().begin(), cut.triangles().end() }, random), places);
  }
  EXPECT_GT(fans, 40);
  EXPECT_LT(fans, 2000);
}

TEST(PolygonTriangulation, CornersOnASideMakeNoFlatTriangles)
{
  // The first two corners of the second one are on a line with the third one, as of a coarse cell
  // beside finer ones.
  const std::vector<double> polygons[] = { { 0, 0, 5, 1, 0, 5, 2, 0, 5, 2, 2, 5, 0, 2, 5 },
    { 0, 0, 0, 3, 0.3, 0, 9, 0.9, 0, 10, 1, 0, 5, 7, 0 } };
  for (const std::vector<double>& corners : polygons)
  {
    const PolygonTriangulation cut = cutOf(corners);
    EXPECT_FALSE(cut.isFan());
    for (const Triangle& triangle : cut.triangles())
    {
      const Vector area = areaOf(corners, triangle);
      EXPECT_GT(std::sqrt(dot(area, area)), 0.5);
    }
  }
}

TEST(PolygonTriangulation, TellsOfAPolygonThatCrossesItself)
{
  EXPECT_TRUE(cutOf({ 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0 }).overlaps());
  EXPECT_TRUE(cutOf({ 0, 0, 0, 4, 0, 0, 4, 4, 0, 3, -1, 0, 0, 4, 0 }).overlaps());
  // All corners on a line, or at one place: no area, nothing to overlap.
  EXPECT_FALSE(cutOf({ 0, 0, 0, 1, 1, 0, 2, 2, 0, 3, 3, 0 }).overlaps());
  EXPECT_FALSE(cutOf({ 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3 }).overlaps());
}

TEST(PolygonTriangulation, ManyCornersTakeLittleMoreThanLinearTime)
{
  // Comparing each ear with each corner would take 10^10 comparisons.
  const std::vector<randompolygon::Point> comb = randompolygon::comb(20'000);
  std::vector<double> corners;
  for (const auto& [x, y] : comb)
  {
    corners.insert(corners.end(), { x, y, 0.0 });
  }
  std::int64_t polls = 0;
  PolygonTriangulation cut;
  cut.cut(corners, [&polls] { ++polls; });
  EXPECT_EQ(cut.triangles().size(), comb.size() - 2);
  EXPECT_FALSE(cut.overlaps());
  EXPECT_GT(polls, 100);

  // Nor does a polygon that crosses itself everywhere take more.
  Random random(2);
  for (double& coordinate : corners)
  {
    coordinate = random.uniform();
  }
  cut.cut(corners, [] {});
  EXPECT_EQ(cut.triangles().size(), comb.size() - 2);
  EXPECT_TRUE(cut.overlaps());
}

} // namespace
} // namespace smg::testing
