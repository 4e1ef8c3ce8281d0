// SPDX-License-Identifier: BSD-3-Clause
#include "Examples/CustomOperators/cxx/PaperOperators.h"
#include "Testing/Solver/HierarchyTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

// The operators of the paper between two levels, as its section 2.1 and its equations (4) and (5)
// define them. CustomOperatorsTest.cpp solves with them.

namespace smg::testing
{
namespace
{

/** The paper's operators with the Galerkin product itself, and a record. */
struct RecordedPaper : PaperRows<RecordedPaper>
{
  static constexpr const char* name = "recorded paper";
  std::shared_ptr<CoarseningRecord> record;

  void interpolate(CoarseningData& data, std::int64_t i) const
  {
    PaperRows::interpolate(data, i);
    const CoarseIndex coarse = data.coarseIndex[i];
    this->record->coarseIndex.push_back(
      coarse == CoarseningData::FPoint ? -1 : std::int64_t(coarse));
    this->record->addParents(data, i);
  }
  void sparsify(const CoarseningData& data, std::int64_t c) const { this->record->addRaw(data, c); }
};

/** Surfaces and tetrahedra, of all weights, with and without constraints. */
std::vector<TestLevel> paperLevels()
{
  const StreamMesh surface = toStream(shuffled(grid(40, 31, 0.3)));
  const StreamMesh rightAngles = toStream(grid(20, 20, 0.0)); // with weights of 0
  const StreamMesh solid = toStream(shuffled(tetBox(8, 7, 9, 0.15)));
  return { finestLevel(surface, Weights::Uniform), finestLevel(surface, Weights::Clamped, 9),
    finestLevel(surface, Weights::Cotangent, 17), finestLevel(rightAngles, Weights::Cotangent, 31),
    finestLevel(solid, Weights::Clamped, 13), finestLevel(solid, Weights::Cotangent) };
}

/** The neighbours of i that count, and their weights. */
std::map<std::int64_t, double> coupled(const TestLevel& level, std::int64_t i)
{
  std::map<std::int64_t, double> neighbours;
  for (const RowEntry& entry : level.rows[i])
  {
    if (entry.weight() > 1e-6F * level.strongest(i))
    {
      neighbours[i + entry.delta()] = entry.weight();
    }
  }
  return neighbours;
}

} // namespace

TEST(PaperOperators, ANodeIsLiftedUnlessANeighbourBeforeItIs)
{
  for (const TestLevel& level : paperLevels())
  {
    const std::vector<std::int64_t> coarse = coarsen(level, RecordedPaper{}).record.coarseIndex;
    ASSERT_EQ(coarse.size(), level.rows.size());
    std::int64_t next = 0;
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      const auto isBefore = [&](const auto& other)
      { return other.first < i && coarse[other.first] >= 0; };
      const bool isLifted =
        !level.rows[i].empty() && std::ranges::none_of(coupled(level, i), isBefore);
      ASSERT_EQ(coarse[i], isLifted ? next : -1) << "node " << i;
      next += isLifted ? 1 : 0;
    }
    EXPECT_GT(next, level.nodes() / 12);
    EXPECT_LT(next, 2 * level.nodes() / 5);
  }
}

TEST(PaperOperators, LiftedNodesCopyAndRetainedOnesTakeTheWeightedMean)
{
  std::int64_t compared = 0;
  for (const TestLevel& level : paperLevels())
  {
    const CoarseningRecord record = coarsen(level, RecordedPaper{}).record;
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      const auto& parents = record.parents[i];
      if (record.coarseIndex[i] >= 0)
      {
        const std::vector<CoarseningRecord::Parent> copy{ { record.coarseIndex[i], Quanta } };
        ASSERT_EQ(parents, copy);
        continue;
      }
      std::map<std::int64_t, double> mean; // by coarse node
      double Z = std::max(0.0, level.rowSum[i]), pull = 0.0;
      for (const auto& [j, weight] : coupled(level, i))
      {
        if (record.coarseIndex[j] >= 0)
        {
          mean[record.coarseIndex[j]] = weight;
          pull += weight;
          Z += weight;
        }
      }
      ASSERT_EQ(mean.empty(), level.rows[i].empty()) << "node " << i;
      int sum = 0;
      for (const auto& [c, quanta] : parents)
      {
        sum += quanta;
        ASSERT_TRUE(mean.contains(c));
        if (mean.size() <= RelaxedRow::Most) // otherwise the largest of them are scaled
        {
          EXPECT_NEAR(quanta, Quanta * mean[c] / Z, 0.5 * (1 + RelaxedRow::Most));
          ++compared;
        }
      }
      EXPECT_NEAR(sum, mean.empty() ? 0.0 : Quanta * pull / Z, 0.5001);
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(PaperOperators, TheCoarseOperatorIsTheGalerkinProduct)
{
  for (const TestLevel& level : paperLevels())
  {
    const CoarsenedLevel step = coarsen(level, RecordedPaper{}, 50);
    const Eigen::MatrixXd p = step.record.interpolation();
    const Eigen::MatrixXd expected = p.transpose() * level.dense() * p;
    EXPECT_LT((step.coarse.dense() - expected).cwiseAbs().maxCoeff(), 4e-6 * expected.maxCoeff());
  }
}

} // namespace smg::testing
