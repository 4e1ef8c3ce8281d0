// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/FiedlerVector.h"

#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace smg::testing
{
namespace
{

/** A grid graph with all masses and weights 1. */
WeightedGraph gridGraph(std::uint32_t columns, std::uint32_t rows)
{
  WeightedGraph graph;
  const auto add = [&](std::uint32_t other)
  {
    graph.neighbours.push_back(other);
    graph.weights.push_back(1);
  };
  for (std::uint32_t i = 0; i < columns * rows; ++i)
  {
    const std::uint32_t column = i / rows, row = i % rows;
    column > 0 ? add(i - rows) : void();
    row > 0 ? add(i - 1) : void();
    row + 1 < rows ? add(i + 1) : void();
    column + 1 < columns ? add(i + rows) : void();
    graph.begin.push_back(static_cast<std::uint32_t>(graph.edges()));
    graph.masses.push_back(1);
  }
  return graph;
}

double rayleighQuotient(const WeightedGraph& graph, const std::vector<double>& x)
{
  double energy = 0, square = 0;
  for (std::uint32_t i = 0; i < graph.nodes(); ++i)
  {
    graph.forEachEdge(i,
      [&](std::uint32_t j, float weight) { energy += weight * (x[i] - x[j]) * (x[i] - x[j]) / 2; });
    square += graph.masses[i] * x[i] * x[i];
  }
  return energy / square;
}

TEST(FiedlerVector, OfALargeGraphCanBeCancelled)
{
  EXPECT_THROW(fiedlerVector(gridGraph(100, 50), [] { throw Cancelled(); }), Cancelled);
}

TEST(FiedlerVector, OfGridsIsACosineAlongTheLongSide)
{
  for (const auto& [columns, rows] : { std::pair(2u, 1u), std::pair(3u, 1u), std::pair(9u, 4u),
         std::pair(200u, 1u), std::pair(300u, 20u), std::pair(120u, 90u) })
  {
    SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
    const WeightedGraph graph = gridGraph(columns, rows);
    const std::vector<double> vector = fiedlerVector(graph);
    ASSERT_EQ(vector.size(), graph.nodes());
    EXPECT_NEAR(std::accumulate(vector.begin(), vector.end(), 0.0), 0, 1e-9);
    EXPECT_NEAR(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0), 1, 1e-9);
    const double half = std::numbers::pi / columns / 2;
    EXPECT_NEAR(rayleighQuotient(graph, vector) / (4 * std::pow(std::sin(half), 2)), 1, 1e-2);
    double cosine = 0;
    for (std::uint32_t i = 0; i < graph.nodes(); ++i)
    {
      cosine += vector[i] * std::cos(half * (2 * (i / rows) + 1));
    }
    EXPECT_GT(std::abs(cosine) / std::sqrt(graph.nodes() / 2.0), 0.99);
  }
}

TEST(FiedlerVector, RespectsMassesAndWeights)
{
  // Two equal clusters with a weak link: the vector is nearly constant on each, with mean 0.
  WeightedGraph graph = gridGraph(100, 1);
  std::fill_n(graph.masses.begin(), 50, 3.0f);
  for (std::uint32_t node : { 49u, 50u })
  {
    for (std::uint32_t k = graph.begin[node]; k < graph.begin[node + 1]; ++k)
    {
      graph.weights[k] = graph.neighbours[k] == 99 - node ? 1e-6f : graph.weights[k];
    }
  }
  const std::vector<double> vector = fiedlerVector(graph);
  EXPECT_NEAR(vector[0] / vector[99], -1.0 / 3, 1e-3);
  EXPECT_NEAR(vector[49] / vector[0], 1, 1e-3);
  EXPECT_NEAR(vector[50] / vector[99], 1, 1e-3);
}

TEST(FiedlerVector, OfFewerThanTwoNodesIsZero)
{
  EXPECT_TRUE(fiedlerVector(WeightedGraph()).empty());
  EXPECT_EQ(fiedlerVector(gridGraph(1, 1)), std::vector<double>{ 0.0 });
}

TEST(FiedlerVector, OfAStarIsFound)
{
  // All rays join the hub's group when the graph is coarsened.
  WeightedGraph graph;
  constexpr std::uint32_t Rays = 1000;
  for (std::uint32_t i = 1; i <= Rays; ++i)
  {
    graph.neighbours.push_back(i);
  }
  graph.begin.push_back(Rays);
  for (std::uint32_t i = 1; i <= Rays; ++i)
  {
    graph.neighbours.push_back(0);
    graph.begin.push_back(Rays + i);
  }
  graph.weights.assign(2 * Rays, 1);
  graph.masses.assign(Rays + 1, 1);
  std::vector<std::uint32_t> groups;
  EXPECT_EQ(coarsen(graph, groups).nodes(), 1u);
  const std::vector<double> vector = fiedlerVector(graph);
  EXPECT_NEAR(rayleighQuotient(graph, vector), 1, 1e-6);
}

TEST(WeightedGraph, CoarseningKeepsMassesAndWeights)
{
  const WeightedGraph graph = gridGraph(37, 23);
  std::vector<std::uint32_t> groups;
  const WeightedGraph coarse = coarsen(graph, groups);
  EXPECT_LE(coarse.nodes(), graph.nodes() / 2);
  EXPECT_EQ(std::accumulate(coarse.masses.begin(), coarse.masses.end(), 0.0), 37 * 23);
  double crossing = 0;
  for (std::uint32_t i = 0; i < graph.nodes(); ++i)
  {
    graph.forEachEdge(
      i, [&](std::uint32_t j, float weight) { crossing += groups[i] != groups[j] ? weight : 0; });
  }
  EXPECT_EQ(std::accumulate(coarse.weights.begin(), coarse.weights.end(), 0.0), crossing);
  for (std::uint32_t i = 0; i < coarse.nodes(); ++i)
  {
    std::vector<std::uint32_t> others;
    coarse.forEachEdge(i, [&](std::uint32_t j, float) { others.push_back(j); });
    std::ranges::sort(others);
    EXPECT_EQ(std::ranges::adjacent_find(others), others.end());
    EXPECT_EQ(std::ranges::count(others, i), 0);
  }
}

TEST(WeightedGraph, PartsHaveTheirEdges)
{
  // Two paths, 0 2 4 and 1 3: the second as a part.
  WeightedGraph graph;
  graph.begin = { 0, 1, 2, 4, 5, 6 };
  graph.neighbours = { 2, 3, 0, 4, 1, 2 };
  graph.weights = { 1, 5, 1, 2, 5, 2 };
  graph.masses = { 1, 2, 3, 4, 5 };
  std::vector<std::uint32_t> numbers(5);
  WeightedGraph part;
  extract(graph, { 1, 3 }, numbers, part);
  EXPECT_EQ(part.begin, (std::vector<std::uint32_t>{ 0, 1, 2 }));
  EXPECT_EQ(part.neighbours, (std::vector<std::uint32_t>{ 1, 0 }));
  EXPECT_EQ(part.weights, (std::vector<float>{ 5, 5 }));
  EXPECT_EQ(part.masses, (std::vector<float>{ 2, 4 }));
}

} // namespace
} // namespace smg::testing
