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
  for (int k = 0; k < 50'000; ++k)
  {
    SCOPED_TRACE(k);
    const RandomPolygon polygon = randomPolygon(random, k);
    const PolygonTriangulation cut = cutOf(polygon.corners);
    ASSERT_EQ(cut.triangles().size(), polygon.size() - 2);
    ASSERT_FALSE(cut.overlaps());
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
  EXPECT_GT(fans, 500);
  EXPECT_LT(fans, 25'000);
}

TEST(PolygonTriangulation, CornersOnASideMakeNoFlatTriangles)
{
  // The first two corners of the second one are on a line with the third one, as of a coarse cell
  // beside finer ones; the third one is an L, with corners on all sides. Up to the noise of a
  // drawing.
  std::vector<double> L;
  for (const auto& [x, y, dx, dy] : { std::array{ 0, 0, 2, 0 }, { 10, 0, 0, 1 }, { 10, 5, -1, 0 },
         { 5, 5, 0, 1 }, { 5, 10, -1, 0 }, { 0, 10, 0, -2 } })
  {
    for (int k = 0; k < 5; ++k)
    {
      L.insert(L.end(), { double(x + k * dx), double(y + k * dy), 1.0 });
    }
  }
  Random random(3);
  for (const std::vector<double>& corners :
    { std::vector<double>{ 0, 0, 5, 1, 0, 5, 2, 0, 5, 2, 2, 5, 0, 2, 5 },
      { 0, 0, 0, 3, 0.3, 0, 9, 0.9, 0, 10, 1, 0, 5, 7, 0 }, L })
  {
    for (const double noise : { 0.0, 1e-12, 1e-9, 1e-6, 1e-5 })
    {
      std::vector<double> noisy = corners;
      std::ranges::for_each(noisy, [&](double& x) { x += random.uniform(-noise, noise); });
      const PolygonTriangulation cut = cutOf(noisy);
      EXPECT_FALSE(cut.isFan());
      for (const Triangle& triangle : cut.triangles())
      {
        const Vector area = areaOf(noisy, triangle);
        EXPECT_GT(std::sqrt(dot(area, area)), 0.3) << noise;
      }
    }
  }
}

/** A polygon that may name a vertex several times, as its triangles and restored from them. */
std::size_t cornersOfRestored(
  const std::vector<std::uint32_t>& polygon, const std::vector<double>& places, Random& random)
{
  std::vector<double> corners;
  for (const std::uint32_t corner : polygon)
  {
    corners.insert(corners.end(), places.begin() + 3 * corner, places.begin() + 3 * corner + 3);
  }
  const PolygonTriangulation cut = cutOf(corners);
  std::vector<Triangle> triangles;
  for (const Triangle& triangle : cut.triangles())
  {
    triangles.push_back({ polygon[triangle[0]], polygon[triangle[1]], polygon[triangle[2]] });
  }
  return restored(triangles, random).size();
}

TEST(PolygonTriangulation, OfRepeatedCornersIsRestored)
{
  // Of few numbers, as of a triangle that is written as a quadrilateral: restoring ends.
  Random random(4);
  for (int k = 0; k < 20'000; ++k)
  {
    std::vector<std::uint32_t> polygon(static_cast<std::size_t>(4 + random.below(5)));
    std::ranges::generate(polygon, [&] { return static_cast<std::uint32_t>(random.below(9)); });
    std::vector<double> places(3 * 9);
    std::ranges::generate(places, [&] { return double(random.below(4)); });
    const std::size_t back = cornersOfRestored(polygon, places, random);
    EXPECT_TRUE(back == 0 || back == polygon.size()) << k;
  }
  // A hole that is joined to the outline at one vertex comes back.
  std::vector<std::uint32_t> frame{ 0, 1, 2, 3, 0, 4, 5, 6, 7, 4 };
  const std::vector<double> places{ 0, 0, 0, 6, 0, 0, 6, 6, 0, 0, 6, 0, 2, 2, 0, 2, 4, 0, 4, 4, 0,
    4, 2, 0 };
  for (std::size_t first = 0; first < frame.size(); ++first)
  {
    std::rotate(frame.begin(), frame.begin() + 1, frame.end());
    EXPECT_EQ(cornersOfRestored(frame, places, random), frame.size()) << first;
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
