// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/PointTree.h"

#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace smg::testing
{
namespace
{

std::vector<double> randomPoints(std::int64_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<double> points(static_cast<std::size_t>(3 * count));
  std::generate(points.begin(), points.end(), [&random] { return random.uniform(-1.0, 1.0); });
  return points;
}

std::span<const double, 3> tripleOf(const std::vector<double>& points, std::int64_t i)
{
  return std::span(points).subspan(3 * static_cast<std::size_t>(i)).first<3>();
}

} // namespace

TEST(PointTree, FindsTheNearestOfAllPoints)
{
  for (const std::int64_t count : { 0, 1, 8, 9, 17, 1000 })
  {
    const std::vector<double> points = randomPoints(count, 3);
    const PointTree tree(points);
    const std::vector<double> places = randomPoints(200, 4);
    for (std::int64_t p = 0; p < 200; ++p)
    {
      PointTree::Nearest expected;
      for (std::int64_t i = 0; i < count; ++i)
      {
        const double squared = PointTree::squaredDistance(tripleOf(points, i), tripleOf(places, p));
        if (squared < expected.squaredDistance)
        {
          expected.point = i;
          expected.squaredDistance = squared;
        }
      }
      const PointTree::Nearest found = tree.nearest(tripleOf(places, p));
      EXPECT_EQ(found.point, expected.point);
      EXPECT_EQ(found.squaredDistance, expected.squaredDistance);
      const double limit = expected.squaredDistance;
      EXPECT_EQ(tree.nearest(tripleOf(places, p), limit).point, expected.point);
      EXPECT_EQ(tree.nearest(tripleOf(places, p), 0.999 * limit).point, -1);
    }
  }
}

TEST(PointTree, ComparesWithFewPoints)
{
  const std::vector<double> places = randomPoints(1000, 4);
  const auto meanCompared = [&places](std::int64_t count)
  {
    const PointTree tree(randomPoints(count, 3));
    std::int64_t sum = 0;
    for (std::int64_t p = 0; p < 1000; ++p)
    {
      sum += tree.nearest(tripleOf(places, p)).compared;
    }
    return static_cast<double>(sum) / 1000.0;
  };
  const double few = meanCompared(1000);
  EXPECT_GT(few, 1.0);
  EXPECT_LT(few, 100.0);
  // A hundred times as many points take a few more levels of the tree, not a hundred times as long.
  EXPECT_LT(meanCompared(100000), 2.0 * few);
}

} // namespace smg::testing
