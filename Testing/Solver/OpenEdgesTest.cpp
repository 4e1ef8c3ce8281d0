// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/OpenEdges.h"
#include "Solver/Core/Timer.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <map>

namespace smg::testing
{

TEST(OpenEdges, sumTheWeightOfEachEdgeWhateverTheirNumber)
{
  Pool pool(1 << 24);
  OpenEdges edges(pool, 4);
  std::vector<std::map<std::int64_t, double>> expected(100);
  Random random(1);
  edges.extend(100);
  for (int trial = 0; trial < 20000; ++trial)
  {
    // Low vertices have few neighbours, high ones many more than the usual number.
    const std::int64_t from = random.below(100);
    const std::int64_t to = 5000000000 + random.below(from + 1);
    const double weight = random.uniform();
    edges.edge(from, to).weight += weight;
    expected[from][to] += weight;
  }
  std::vector<OpenEdge> row;
  for (std::int64_t from = 0; from < 100; ++from)
  {
    edges.take(from, row);
    ASSERT_EQ(row.size(), expected[from].size());
    std::size_t e = 0;
    for (const auto& [to, weight] : expected[from])
    {
      EXPECT_EQ(row[e].to, to);
      EXPECT_EQ(row[e++].weight, weight);
    }
  }
}

TEST(OpenEdges, newEdgesBeginWithNoWeight)
{
  Pool pool(1 << 20);
  OpenEdges edges(pool, 2);
  edges.extend(1);
  std::vector<OpenEdge> row;
  edges.take(0, row);
  EXPECT_TRUE(row.empty());
  for (const std::int64_t to : { 9, 3, 7 })
  {
    EXPECT_EQ(edges.edge(0, to).weight, 0.0);
  }
}

TEST(OpenEdges, keepMemoryForOpenVerticesOnly)
{
  Pool pool(1 << 20);
  OpenEdges edges(pool, 12);
  std::vector<OpenEdge> row;
  for (std::int64_t v = 0; v < 100000; ++v)
  {
    edges.extend(v + 1);
    edges.edge(v, v + 1).weight = static_cast<double>(v);
    if (v >= 100)
    {
      edges.take(v - 100, row);
      ASSERT_EQ(row.size(), 1U);
      ASSERT_EQ(row[0].weight, static_cast<double>(v - 100));
      edges.release(v - 99);
    }
  }
  EXPECT_LT(pool.peak(), 200000);
}

/** The time for a vertex is in proportion to its neighbours, not to their square. */
TEST(OpenEdges, aVertexMayHaveVeryManyNeighbours)
{
  Pool pool(1 << 20);
  OpenEdges edges(pool, 12);
  edges.extend(1);
  const Timer timer;
  for (int round = 0; round < 2; ++round)
  {
    for (std::int64_t to = 0; to < 100000; ++to)
    {
      edges.edge(0, (to * 77773) % 100000).weight += 1.0;
    }
  }
  std::vector<OpenEdge> row;
  edges.take(0, row);
  ASSERT_EQ(row.size(), 100000U);
  for (std::int64_t to = 0; to < 100000; ++to)
  {
    ASSERT_EQ(row[to].to, to);
    ASSERT_EQ(row[to].weight, 2.0);
  }
  EXPECT_LT(timer.seconds(), 1.0);
}

} // namespace smg::testing
