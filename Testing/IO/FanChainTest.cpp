// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/TriangleChains.h"

#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace smg::testing
{
namespace
{

using Triangle = std::array<std::uint32_t, 3>;
using Polygon = std::vector<std::uint32_t>;

std::vector<Triangle> fanOf(std::span<const std::uint32_t> polygon)
{
  std::vector<Triangle> fan;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    fan.push_back({ polygon[0], polygon[i - 1], polygon[i] });
  }
  return fan;
}

/** The polygon of the triangles; empty if they are not a fan. */
Polygon polygonOf(const std::vector<Triangle>& triangles)
{
  Polygon corners;
  for (const Triangle& triangle : triangles)
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  FanChain chain;
  return chain.build(corners) ? Polygon(chain.polygon().begin(), chain.polygon().end()) : Polygon();
}

void shuffle(std::vector<Triangle>& triangles, Random& random)
{
  for (std::size_t i = triangles.size(); i > 1; --i)
  {
    std::swap(triangles[i - 1], triangles[std::size_t(random.below(std::int64_t(i)))]);
  }
}

TEST(FanChain, FindsAPolygonWhateverTheOrder)
{
  Random random(1);
  for (int corners = 3; corners < 60; ++corners)
  {
    Polygon polygon;
    for (int i = 0; i < corners; ++i)
    {
      polygon.push_back(std::uint32_t(1000 * random.below(1000) + i));
    }
    std::vector<Triangle> triangles = fanOf(polygon);
    shuffle(triangles, random);
    EXPECT_EQ(polygonOf(triangles), polygon);
  }
}

/** Several polygons yield these triangles; the original one is unknown. */
TEST(FanChain, FindsAPolygonOfTheSameTrianglesIfCornersAreRepeated)
{
  Random random(2);
  for (int i = 0; i < 300; ++i)
  {
    Polygon polygon(std::size_t(4 + random.below(12)));
    std::ranges::generate(polygon, [&random] { return std::uint32_t(random.below(4)); });
    std::vector<Triangle> triangles = fanOf(polygon);
    shuffle(triangles, random);
    const std::vector<Triangle> again = fanOf(polygonOf(triangles));
    EXPECT_TRUE(std::ranges::is_permutation(again, triangles));
  }
}

TEST(FanChain, RefusesWhatIsNoFan)
{
  EXPECT_TRUE(polygonOf({ { 0, 1, 2 }, { 2, 1, 3 } }).empty()) << "first corners differ";
  EXPECT_TRUE(polygonOf({ { 0, 1, 2 }, { 0, 3, 4 } }).empty()) << "two fans";
  EXPECT_TRUE(polygonOf({ { 0, 1, 2 }, { 0, 1, 3 } }).empty()) << "two ends";
  EXPECT_TRUE(polygonOf({ { 0, 1, 3 }, { 0, 2, 3 } }).empty()) << "two beginnings";
  EXPECT_TRUE(polygonOf({ { 0, 1, 2 }, { 0, 2, 1 }, { 0, 3, 4 }, { 0, 4, 3 } }).empty())
    << "two closed fans";
  EXPECT_TRUE(polygonOf({ { 0, 1, 2 }, { 0, 3, 4 }, { 0, 4, 3 } }).empty())
    << "an open and a closed fan";
}

} // namespace
} // namespace smg::testing
