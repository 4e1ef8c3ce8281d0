// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Edges.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <map>

namespace smg::testing
{

TEST(OpenEdges, SumTheWeightOfEachEdgeWhateverTheirNumber)
{
  // Low vertices have many more neighbours than the usual number, high ones few.
  constexpr std::int64_t Vertices = 100;
  Pool pool(1 << 24);
  OpenEdges edges(pool, 4);
  edges.extend(Vertices);
  std::vector<std::map<std::int64_t, double>> expected(Vertices);
  Random random(1);
  for (int trial = 0; trial < 4000; ++trial)
  {
    const std::int64_t a = random.below(Vertices);
    const std::int64_t b = random.below(1 + a / 2);
    if (a != b)
    {
      const double weight = random.uniform();
      (trial % 2 == 0 ? edges.weight(a, b) : edges.weight(b, a)) += weight;
      expected[a][b] += weight;
      expected[b][a] += weight;
    }
  }
  std::vector<OpenEdge> row;
  for (std::int64_t from = 0; from < Vertices; ++from)
  {
    row.clear();
    edges.take(from, row);
    edges.release(from + 1);
    ASSERT_EQ(row.size(), expected[from].size());
    std::size_t e = 0;
    for (const auto& [to, weight] : expected[from])
    {
      EXPECT_EQ(row[e].to, to);
      EXPECT_EQ(row[e++].weight, weight);
    }
  }
}

TEST(OpenEdges, NewEdgesBeginWithNoWeight)
{
  Pool pool(1 << 20);
  OpenEdges edges(pool, 4);
  edges.extend(10);
  std::vector<OpenEdge> row;
  row.clear();
  edges.take(0, row);
  EXPECT_TRUE(row.empty());
  for (const std::int64_t to : { 9, 3, 7, 8, 4, 6 })
  {
    EXPECT_EQ(edges.weight(1, to), 0.0);
    edges.weight(1, to) = 1.0;
  }
}

TEST(OpenEdges, AVertexGetsTheEdgesThatLowerOnesHaveTaken)
{
  Pool pool(1 << 20);
  OpenEdges edges(pool, 4);
  edges.extend(9);
  std::vector<OpenEdge> row;
  for (std::int64_t v = 0; v < 8; ++v)
  {
    edges.weight(8, v) = static_cast<double>(v);
    row.clear();
    edges.take(v, row);
    ASSERT_EQ(row.size(), 1U);
    EXPECT_EQ(row[0].to, 8);
  }
  row.clear();
  edges.take(8, row);
  ASSERT_EQ(row.size(), 8U);
  for (std::int64_t v = 0; v < 8; ++v)
  {
    EXPECT_EQ(row[v].to, v);
    EXPECT_EQ(row[v].weight, static_cast<double>(v));
  }
}

TEST(OpenEdges, KeepMemoryForOpenVerticesOnly)
{
  Pool pool(1 << 20);
  OpenEdges edges(pool, 12);
  std::vector<OpenEdge> row;
  for (std::int64_t v = 0; v < 100000; ++v)
  {
    edges.extend(v + 1);
    if (v > 0)
    {
      edges.weight(v - 1, v) = static_cast<double>(v);
    }
    if (v >= 100)
    {
      row.clear();
      edges.take(v - 100, row);
      ASSERT_EQ(row.size(), v > 100 ? 2U : 1U);
      ASSERT_EQ(row.back().weight, static_cast<double>(v - 99));
      edges.release(v - 99);
    }
  }
  EXPECT_LT(pool.peak(), 200000);
}

/** A star, whose hub has its edges in the separate table, whether it comes first or last. */
TEST(OpenEdges, CountTheirMemoryOfVeryManyNeighbours)
{
  constexpr std::int64_t Neighbours = 20000, Each = 48; // a node with a bucket
  for (const bool isLast : { false, true })
  {
    Pool pool(1 << 26);
    OpenEdges edges(pool, 12);
    edges.extend(Neighbours + 1);
    const std::int64_t before = pool.used();
    const std::int64_t hub = isLast ? Neighbours : 0;
    for (std::int64_t k = 0; k < Neighbours; ++k)
    {
      edges.weight(hub, isLast ? k : k + 1) = 1.0;
    }
    std::vector<OpenEdge> taken;
    for (std::int64_t i = 0; isLast && i < Neighbours; ++i)
    {
      edges.take(i, taken);
    }
    EXPECT_GE(pool.used() - before, (Neighbours - 12) * Each) << isLast;
    edges.take(hub, taken);
    edges.release(hub + 1);
    EXPECT_EQ(pool.used(), before) << isLast;
  }

  Pool small(1 << 20);
  OpenEdges edges(small, 4);
  edges.extend(5000);
  EXPECT_THROW(
    {
      for (std::int64_t to = 1; to < 5000 * 4; ++to)
      {
        edges.weight(0, to);
      }
    },
    Error);
}

/** The time per vertex is linear in its number of neighbours: with a quadratic one the test would
 * not end. */
TEST(OpenEdges, AVertexMayHaveVeryManyNeighbours)
{
  Pool pool(1 << 27);
  OpenEdges edges(pool, 12);
  constexpr std::int64_t Last = 500000;
  edges.extend(Last + 1);
  for (int round = 0; round < 2; ++round)
  {
    for (std::int64_t v = 1; v < Last; ++v)
    {
      edges.weight(0, v) += 1.0;
      edges.weight(Last, v) += 1.0;
    }
  }
  std::vector<OpenEdge> row;
  for (const std::int64_t from : { std::int64_t(0), Last })
  {
    for (std::int64_t v = 1; from > 0 && v < Last; ++v)
    {
      row.clear();
      edges.take(v, row);
      ASSERT_EQ(row.size(), 2U);
    }
    row.clear();
    edges.take(from, row);
    ASSERT_EQ(row.size(), static_cast<std::size_t>(Last - 1));
    for (std::int64_t v = 1; v < Last; ++v)
    {
      ASSERT_EQ(row[v - 1].to, v);
      ASSERT_EQ(row[v - 1].weight, 2.0);
    }
  }
}

} // namespace smg::testing
