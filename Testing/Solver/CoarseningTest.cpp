// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Coarsening.h"
#include "Testing/Solver/CoarseningTesting.h"
#include "Testing/Support/Combinations.h"

#include <gtest/gtest.h>

namespace smg::testing
{
TEST(Coarsening, LiftedNodesAreAMaximalIndependentSetOfTheStrongEdges)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const auto& coarseIndex = step.record.coarseIndex;
    ASSERT_EQ(coarseIndex.size(), test.level.rows.size());
    std::int64_t next = 0;
    for (std::int64_t i = 0; i < test.level.nodes(); ++i)
    {
      const float strong = test.strong(i);
      bool dependsOnLifted = false;
      for (const RowEntry& entry : test.level.rows[i])
      {
        dependsOnLifted = dependsOnLifted || (entry.delta() < 0 && entry.weight() >= strong &&
                                               coarseIndex[i + entry.delta()] >= 0);
      }
      // Next to constrained nodes with negative weights, weights can sum to well over 1.
      const bool exceeds = test.level.rowSum[i] < -0.5 * test.level.diagonal(i);
      const bool expected = (!dependsOnLifted || exceeds) && !test.level.rows[i].empty();
      ASSERT_EQ(coarseIndex[i], expected ? next : -1) << test.name << ", node " << i;
      next += expected ? 1 : 0;
    }
    EXPECT_EQ(next, step.coarse.nodes());
    EXPECT_LT(next, test.level.nodes() / 2);
  }
}

TEST(Coarsening, TheRawProductIsTheGalerkinProduct)
{
  Combinations combinations;
  for (CoarseningCase& test : coarseningCases())
  {
    if (!combinations.next())
    {
      continue;
    }
    test.operators.tolerance = 0.0F;
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const Eigen::MatrixXd p = step.record.interpolation();
    const Eigen::MatrixXd expected = p.transpose() * test.level.dense() * p;
    const Eigen::MatrixXd product = step.coarse.dense();
    EXPECT_EQ(product, product.transpose());
    // Intermediate entries and row sums are floats.
    EXPECT_LT((product - expected).cwiseAbs().maxCoeff(), 4e-6 * expected.maxCoeff()) << test.name;
    const Eigen::VectorXd rowSums = expected.rowwise().sum();
    for (std::int64_t c = 0; c < step.coarse.nodes(); ++c)
    {
      EXPECT_NEAR(step.coarse.rowSum[c], rowSums[c], 1e-7 * expected(c, c)) << test.name;
    }
  }
}

TEST(Coarsening, RowSumsOfAFreeComponentAreZeroOnEveryLevel)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    TestLevel level = test.level;
    for (int depth = 0; test.free && level.nodes() > 3; ++depth)
    {
      for (const double rowSum : level.rowSum)
      {
        ASSERT_EQ(rowSum, 0.0) << test.name << ", level " << depth;
      }
      ASSERT_LT(depth, 10);
      level = coarsen(level, test.operators).coarse;
    }
  }
}

/** Meshes whose windows reuse the memory of released neighbours of a neighbour. */
TEST(Coarsening, WhatIsGoneIsNotLookedAt)
{
  RecordingOperators operators;
  operators.strength = 0.05F;
  operators.finestEntries = operators.entries = 5;
  for (const TestLevel& level :
    { finestLevel(toStream(shuffled(tetBox(31, 16, 16, 0.2))), Weights::Uniform),
      finestLevel(toStream(shuffled(tetBox(35, 22, 20, 0.2))), Weights::Clamped) })
  {
    const CoarsenedLevel whole = coarsen(level, operators);
    const CoarsenedLevel parts = coarsen(level, operators, 16);
    EXPECT_TRUE(sameLevels(parts.coarse, whole.coarse)) << level.nodes();
  }
}

TEST(Coarsening, DoesNotDependOnHowManyRowsComeAtOnce)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel whole = coarsen(test.level, test.operators);
    for (const std::int64_t batch : { 1, 7, 64, 200 })
    {
      const CoarsenedLevel parts = coarsen(test.level, test.operators, batch);
      EXPECT_EQ(parts.record.coarseIndex, whole.record.coarseIndex) << test.name;
      EXPECT_EQ(parts.record.parents, whole.record.parents) << test.name;
      EXPECT_TRUE(sameLevels(parts.record.raw, whole.record.raw)) << test.name;
      EXPECT_TRUE(sameLevels(parts.coarse, whole.coarse)) << test.name << ", batch " << batch;
    }
  }
}

TEST(Coarsening, StiffNodesStayAndTheirRowsAreNotSparsified)
{
  for (const double scale : { 1.0, 1e-5 })
  {
    const SliverRows rule(SliverRows::Triangles, scale);
    TestLevel level = finestLevel(toStream(sliverChains(40, 30, 1e-3)), Weights::Cotangent, 17);
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      for (RowEntry& entry : level.rows[i])
      {
        entry.setWeight(entry.weight() * static_cast<float>(scale));
      }
      level.rowSum[i] *= scale;
    }
    for (int l = 0; l < 3; ++l)
    {
      const CoarsenedLevel step = coarsen(level, {}, 50, rule);
      const TestLevel& raw = step.record.raw;
      std::int64_t stiff = 0, sparsified = 0;
      for (std::int64_t i = 0; i < level.nodes(); ++i)
      {
        const bool isStiff = level.least(i) < SliverRows::Triangles * scale;
        stiff += isStiff ? 1 : 0;
        EXPECT_TRUE(!isStiff || step.record.coarseIndex[i] >= 0);
      }
      EXPECT_GT(stiff, 100);
      EXPECT_TRUE(l > 0 || stiff < level.nodes() / 2);
      for (std::int64_t c = 0; c < raw.nodes(); ++c)
      {
        const bool isStiff = raw.least(c) < SliverRows::Triangles * scale;
        EXPECT_EQ(step.record.rawStiff[c], isStiff);
        const bool fewer = step.coarse.rows[c].size() < raw.rows[c].size();
        EXPECT_FALSE(fewer && isStiff);
        sparsified += fewer ? 1 : 0;
      }
      EXPECT_TRUE(l > 0 || sparsified > 0);
      level = step.coarse;
      level.finest = false;
    }
  }
}

TEST(Coarsening, NodesWithoutEdgesHaveNoParent)
{
  TestLevel level;
  level.rows = { {}, { { 2, 1.0F } }, {}, { { -2, 1.0F } }, {} };
  level.rowSum = { 1.0, 0.0, 1.0, 0.5, 1.0 };
  for (const std::int64_t batch : { 1, 5 })
  {
    const CoarsenedLevel step = coarsen(level, {}, batch);
    EXPECT_EQ(step.record.coarseIndex, (std::vector<std::int64_t>{ -1, 0, -1, -1, -1 }));
    EXPECT_TRUE(step.record.parents[0].empty());
    ASSERT_EQ(step.coarse.nodes(), 1);
    EXPECT_TRUE(step.coarse.rows[0].empty());
    EXPECT_GT(step.coarse.rowSum[0], 0.0);
  }
}

TEST(Coarsening, OfALevelWithoutNodesIsOneWithoutNodes)
{
  Pool pool(1 << 24);
  LevelRows fine(pool);
  LevelRows coarse(pool);
  Coarsening<RecordingOperators> step(pool, {}, fine, coarse);
  fine.Ended = true;
  step.advance();
  step.handOver();
  EXPECT_TRUE(coarse.Ended);
  EXPECT_EQ(coarse.end(), 0);
}

TEST(Coarsening, KeepsAWindowOnly)
{
  // A long strip: the window is as wide as the strip for any length; also with patches.
  for (const bool slivers : { false, true })
  {
    std::int64_t peak[2];
    for (const int length : { 200, 800 })
    {
      const TestLevel level =
        slivers ? finestLevel(toStream(sliverChains(length, 12, 1e-2)), Weights::Cotangent)
                : finestLevel(toStream(grid(length, 12)), Weights::Uniform);
      Pool pool(1 << 28);
      LevelRows fine(pool);
      LevelRows coarse(pool);
      Coarsening<RecordingOperators> step(pool, {}, fine, coarse);
      for (std::int64_t i = 0; i < level.nodes(); ++i)
      {
        level.append(fine, i, i + 1);
        step.advance();
        step.handOver();
        step.packed(step.multiplied());
        step.release();
        coarse.release(coarse.end(), coarse.end());
      }
      peak[length == 800] = pool.peak();
    }
    EXPECT_LT(peak[1], peak[0] + peak[0] / 10) << slivers;
  }
}

} // namespace smg::testing
