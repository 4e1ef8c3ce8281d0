// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/VertexStar.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace smg::testing
{
namespace
{

using Ranks = std::vector<std::uint32_t>;

class VertexStars : public ::testing::Test
{
protected:
  static constexpr RankRange Range{ 100, 120 };

  /** The neighbours, ascending. */
  Ranks visit(std::uint32_t vertex, const Ranks& link, std::size_t corners = 3)
  {
    Ranks neighbours(link.size());
    neighbours.resize(this->Star.visit(vertex, link, corners, neighbours));
    std::ranges::sort(neighbours);
    return neighbours;
  }

  TemporaryFolder Folder;
  Workspace Space{ Folder.path(), Workspace::MinMemory };
  VertexStar Star{ Space.pool(), Range, 64 };
};

TEST_F(VertexStars, DiscHasNoBoundary)
{
  EXPECT_EQ(
    this->visit(100, { 101, 102, 102, 103, 103, 104, 104, 101 }), (Ranks{ 101, 102, 103, 104 }));
  EXPECT_EQ(this->Star.fans(), 1);
  EXPECT_EQ(this->Star.boundaryEdges(), 0);
  EXPECT_EQ(this->Star.nonManifoldEdges(), 0);
}

TEST_F(VertexStars, FanHasTwoBoundaryEdgesButCountsThoseToHigherRanks)
{
  EXPECT_EQ(this->visit(103, { 105, 104, 102, 105 }), (Ranks{ 102, 104, 105 }));
  EXPECT_EQ(this->Star.fans(), 1);
  EXPECT_EQ(this->Star.boundaryEdges(), 1) << "to 104, not to 102";
}

TEST_F(VertexStars, TwoFansAreNotManifold)
{
  this->visit(100, { 101, 102, 103, 104 });
  EXPECT_EQ(this->Star.fans(), 2);
  EXPECT_EQ(this->Star.boundaryEdges(), 4);
  this->visit(100, { 101, 102, 103, 104, 104, 102 });
  EXPECT_EQ(this->Star.fans(), 1) << "connected by the last triangle";
}

TEST_F(VertexStars, EdgeOfThreeTrianglesIsNotManifold)
{
  this->visit(100, { 101, 102, 101, 103, 101, 104 });
  EXPECT_EQ(this->Star.nonManifoldEdges(), 1);
  EXPECT_EQ(this->Star.boundaryEdges(), 3);
  EXPECT_EQ(this->Star.fans(), 1);
}

TEST_F(VertexStars, TriangleThatIsThereTwiceCountsTwice)
{
  EXPECT_EQ(this->visit(100, { 101, 102, 102, 101 }), (Ranks{ 101, 102 }));
  EXPECT_EQ(this->Star.boundaryEdges(), 0);
  EXPECT_EQ(this->Star.fans(), 1);
}

TEST_F(VertexStars, RepeatedCornersJoinButAreNoTriangle)
{
  EXPECT_EQ(this->visit(100, { 101, 101, 100, 102, 100, 100 }), (Ranks{ 101, 102 }));
  EXPECT_EQ(this->Star.boundaryEdges(), 0);
  EXPECT_EQ(this->Star.fans(), 0);
}

TEST_F(VertexStars, NeighboursMayBeOutsideTheRange)
{
  EXPECT_EQ(this->visit(119, { 500, 7, 7, 118, 118, 500 }), (Ranks{ 7, 118, 500 }));
  EXPECT_EQ(this->Star.boundaryEdges(), 0);
  EXPECT_EQ(this->Star.fans(), 1);
  this->visit(119, { 500, 7, 118, 8 });
  EXPECT_EQ(this->Star.boundaryEdges(), 1) << "to 500 alone";
  EXPECT_EQ(this->Star.fans(), 2);
}

TEST_F(VertexStars, TetrahedraGiveEachNeighbourOnce)
{
  EXPECT_EQ(
    this->visit(110, { 111, 112, 3, 112, 3, 900, 110, 111, 900 }, 4), (Ranks{ 3, 111, 112, 900 }));
}

TEST_F(VertexStars, AgreeWithCountingByHand)
{
  Random random(1);
  for (int i = 0; i < 2000; ++i)
  {
    const auto vertex = static_cast<std::uint32_t>(100 + random.below(20));
    Ranks link;
    for (std::int64_t ends = 2 * random.below(12); ends > 0; --ends)
    {
      link.push_back(static_cast<std::uint32_t>(95 + random.below(30)));
    }
    std::set<std::uint32_t> neighbours(link.begin(), link.end());
    neighbours.erase(vertex);
    std::map<std::uint32_t, int> triangles;
    std::map<std::uint32_t, std::uint32_t> fan;
    for (std::size_t k = 0; k < link.size(); k += 2)
    {
      const std::uint32_t a = link[k], b = link[k + 1];
      if (a != b && a != vertex && b != vertex)
      {
        ++triangles[a];
        ++triangles[b];
        fan.try_emplace(a, a);
        fan.try_emplace(b, b);
        for (const std::uint32_t from = fan[a], to = fan[b]; auto& [end, name] : fan)
        {
          name = name == from ? to : name;
        }
      }
    }
    std::set<std::uint32_t> fans;
    std::int64_t boundary = 0, nonManifold = 0;
    for (const auto& [end, count] : triangles)
    {
      fans.insert(fan[end]);
      boundary += end > vertex && count == 1;
      nonManifold += end > vertex && count > 2;
    }
    ASSERT_EQ(this->visit(vertex, link), Ranks(neighbours.begin(), neighbours.end()));
    ASSERT_EQ(this->Star.fans(), std::int64_t(fans.size()));
    ASSERT_EQ(this->Star.boundaryEdges(), boundary);
    ASSERT_EQ(this->Star.nonManifoldEdges(), nonManifold);
  }
}

} // namespace
} // namespace smg::testing
