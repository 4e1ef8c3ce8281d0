// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/CoarseningTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace smg::testing
{
namespace
{

/** A row of P in double precision: a weight for each coarse node, and separately their sum. */
struct Row
{
  Eigen::RowVectorXd weights;
  double sum = 0.0;
};

/** Checks each relaxed row of a recorded interpolation against the formula, given the rows that it
 * depends on. */
class RelaxationCheck
{
public:
  RelaxationCheck(const CoarseningCase& test, const CoarsenedLevel& step)
    : Test(test)
    , Step(step)
    , A(test.level.dense())
    , PatchOf(patchesOf(test.level))
  {
  }

  Row recorded(std::size_t sweep, std::int64_t i) const
  {
    const auto& from = this->Step.record.sweeps[sweep][i];
    Row row{ Eigen::RowVectorXd::Zero(this->Step.coarse.nodes()), from.sum };
    for (const auto& [coarse, weight] : from.entries)
    {
      row.weights[coarse] += weight;
    }
    return row;
  }

  bool coarseIndex(std::int64_t i) const { return this->Step.record.coarseIndex[i] >= 0; }

  /** Row i of P0. */
  Row initial(std::int64_t i) const
  {
    const TestLevel& fine = this->Test.level;
    Row row{ Eigen::RowVectorXd::Zero(this->Step.coarse.nodes()), 1.0 };
    if (this->coarseIndex(i))
    {
      row.weights[this->Step.record.coarseIndex[i]] = 1.0;
      return row;
    }
    for (const RowEntry& entry : fine.rows[i])
    {
      const std::int64_t coarse = this->Step.record.coarseIndex[i + entry.delta()];
      if (coarse >= 0 && entry.weight() >= this->Test.strong(i))
      {
        row.weights[coarse] += entry.weight();
      }
    }
    const double sum = row.weights.sum();
    row.weights /= sum > 0.0 ? sum + std::max(0.0, fine.rowSum[i]) : 1.0;
    row.sum = row.weights.sum();
    return row;
  }

  /** The nodes that are relaxed together with the F-point i. */
  std::vector<std::int64_t> together(std::int64_t i) const
  {
    std::vector<std::int64_t> nodes;
    for (const std::int64_t m : this->PatchOf[i])
    {
      if (!this->coarseIndex(m))
      {
        nodes.push_back(m);
      }
    }
    return nodes;
  }

  /** Whether m is relaxed before node `turn` in a sweep. */
  bool doneBefore(std::int64_t turn, std::int64_t m) const
  {
    return (this->coarseIndex(m) ? m : this->together(m).back()) < turn;
  }
  /** The latest row of m in a sweep when node `turn` is relaxed. */
  Row newest(std::size_t sweep, std::int64_t turn, std::int64_t m) const
  {
    return this->recorded(this->doneBefore(turn, m) ? sweep : sweep - 1, m);
  }

  /** What F-neighbours take from node i, its weight in row i, when they are not in `nodes`,
   * which are relaxed together with it. */
  struct Response
  {
    double ofItself = 0.0; // of the row to come
    Row known;             // of known rows
  };
  Response response(std::size_t sweep, std::int64_t i, const std::vector<std::int64_t>& nodes) const
  {
    const TestLevel& fine = this->Test.level;
    Response plain{ 0.0, { Eigen::RowVectorXd::Zero(this->Step.coarse.nodes()), 0.0 } };
    Response following = plain;
    const auto add = [](Response& to, double weight, const Row& row)
    {
      to.known.weights += weight * row.weights;
      to.known.sum += weight * row.sum;
    };
    for (const RowEntry& entry : fine.rows[i])
    {
      const std::int64_t m = i + entry.delta();
      if (std::ranges::find(nodes, m) != nodes.end())
      {
        continue;
      }
      const double w = entry.weight();
      const Row row = this->newest(sweep, nodes.back(), m);
      add(plain, w, row);
      const bool isRelaxed = sweep > 1 || this->doneBefore(nodes.back(), m);
      const double back = this->coarseIndex(m) || w <= 0.0 ? 0.0
                          : isRelaxed                      ? w * std::min(1.0, w / this->A(m, m))
                                                           : w * w / (this->strongTotal(m) + w);
      following.ofItself += back;
      add(following, isRelaxed ? w : w - back, row);
      if (isRelaxed)
      {
        add(following, -back, this->recorded(sweep - 1, i));
      }
    }
    return this->A(i, i) - following.ofItself > 0.3 * this->A(i, i) ? following : plain;
  }

  /** Row i after a sweep, with all columns. */
  Row relaxed(std::size_t sweep, std::int64_t i) const
  {
    const std::vector<std::int64_t> nodes = this->together(i);
    const Eigen::Index count = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(count, this->Step.coarse.nodes());
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(count);
    for (Eigen::Index k = 0; k < count; ++k)
    {
      const Response response = this->response(sweep, nodes[k], nodes);
      known.row(k) = response.known.weights;
      sums[k] = response.known.sum;
    }
    const Eigen::MatrixXd inverse = this->matrix(sweep, nodes).inverse();
    const auto own = std::ranges::find(nodes, i) - nodes.begin();
    return { inverse.row(own) * known, (inverse.row(own) * sums)[0] };
  }

  /** The coarse nodes in P0 of the neighbours of i. */
  std::set<std::int64_t> pattern(std::int64_t i) const
  {
    std::set<std::int64_t> columns;
    for (const RowEntry& entry : this->Test.level.rows[i])
    {
      for (const auto& [coarse, weight] : this->Step.record.sweeps[0][i + entry.delta()].entries)
      {
        columns.insert(coarse);
      }
    }
    return columns;
  }

  /** Whether a patch is too close to singular to be relaxed as a unit. */
  bool singular(std::size_t sweep, std::int64_t i) const
  {
    return nearlySingular(this->matrix(sweep, this->together(i)), 1e-5);
  }

private:
  /** The matrix of nodes that are relaxed together. */
  Eigen::MatrixXd matrix(std::size_t sweep, const std::vector<std::int64_t>& nodes) const
  {
    Eigen::MatrixXd matrix = partOf(this->A, nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      matrix(k, k) -= this->response(sweep, nodes[k], nodes).ofItself;
    }
    return matrix;
  }

  /** Z of the row of P0. */
  double strongTotal(std::int64_t i) const
  {
    const TestLevel& fine = this->Test.level;
    double total = std::max(0.0, fine.rowSum[i]);
    for (const RowEntry& entry : fine.rows[i])
    {
      const bool strong = entry.weight() >= this->Test.strong(i);
      total += strong && this->coarseIndex(i + entry.delta()) ? entry.weight() : 0.0;
    }
    return total;
  }

  const CoarseningCase& Test;
  const CoarsenedLevel& Step;
  Eigen::MatrixXd A;
  PatchList PatchOf;
};

/** Truncates a row to `most` columns of a pattern, preserving the sum. Returns the smallest
 * remaining magnitude. */
double truncate(
  Row& row, const std::set<std::int64_t>& pattern, int most, const CoarseningRecord::Relaxed& kept)
{
  std::vector<double> sizes;
  for (const std::int64_t coarse : pattern)
  {
    sizes.push_back(std::fabs(row.weights[coarse]));
  }
  std::ranges::sort(sizes, std::greater<>());
  sizes.resize(std::min<std::size_t>(sizes.size(), most));
  // The choice between equal columns is not specified.
  Eigen::RowVectorXd rest = Eigen::RowVectorXd::Zero(row.weights.size());
  for (const auto& [coarse, weight] : kept.entries)
  {
    rest[coarse] = row.weights[coarse];
  }
  const double size = rest.cwiseAbs().sum();
  const double share = size > 0.0 ? (row.sum - rest.sum()) / size : 0.0;
  row.weights = rest + share * rest.cwiseAbs();
  return sizes.empty() ? 0.0 : sizes.back();
}

} // namespace

TEST(Interpolation, BeginsWithTheStrongLiftedNeighbours)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const RelaxationCheck check(test, step);
    for (std::int64_t i = 0; i < test.level.nodes(); ++i)
    {
      const Row expected = check.initial(i);
      const Row row = check.recorded(0, i);
      ASSERT_LT((row.weights - expected.weights).cwiseAbs().sum(), 1e-5) << test.name << ", " << i;
      ASSERT_NEAR(row.sum, expected.weights.sum(), 1e-5) << test.name;
    }
  }
}

TEST(Interpolation, IsRelaxedInPlaceAndTruncated)
{
  std::int64_t patched = 0, negative = 0;
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const RelaxationCheck check(test, step);
    ASSERT_EQ(step.record.sweeps.size(), static_cast<std::size_t>(test.operators.sweeps + 1));
    for (int sweep = 1; sweep <= test.operators.sweeps; ++sweep)
    {
      for (std::int64_t i = 0; i < test.level.nodes(); ++i)
      {
        const auto& kept = step.record.sweeps[sweep][i];
        if (check.coarseIndex(i))
        {
          ASSERT_EQ(kept.entries, step.record.sweeps[0][i].entries);
          continue;
        }
        if (test.level.rows[i].empty() || check.singular(sweep, i))
        {
          continue;
        }
        Row expected = check.relaxed(sweep, i);
        const auto pattern = check.pattern(i);
        ASSERT_LE(kept.entries.size(), static_cast<std::size_t>(test.operators.entries));
        const Row all = expected;
        const double least = truncate(expected, pattern, test.operators.entries, kept);
        const double size = all.weights.cwiseAbs().maxCoeff();
        for (const auto& [coarse, weight] : kept.entries)
        {
          ASSERT_TRUE(pattern.contains(coarse)) << test.name;
          ASSERT_GE(std::fabs(all.weights[coarse]), least - 1e-4 * size) << test.name << ", " << i;
          ASSERT_NEAR(
            weight, expected.weights[coarse], 2e-4 * expected.weights.cwiseAbs().maxCoeff())
            << test.name << ", " << i;
          negative += weight < 0.0F ? 1 : 0;
        }
        ASSERT_EQ(kept.entries.size(),
          std::min(pattern.size(), static_cast<std::size_t>(test.operators.entries)))
          << test.name << ", " << i;
        ASSERT_NEAR(kept.sum, all.sum, 1e-4 * std::max(1.0, std::fabs(all.sum)))
          << test.name << ", " << i;
        patched += check.together(i).size() > 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(patched, 100);
  EXPECT_GT(negative, 100);
}

TEST(Interpolation, IsRoundedToQuantaThatKeepTheRowSum)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    for (std::int64_t i = 0; i < test.level.nodes(); ++i)
    {
      const auto& relaxed = step.record.sweeps.back()[i];
      const auto& parents = step.record.parents[i];
      int sum = 0;
      double size = 0.0;
      for (const auto& [coarse, weight] : relaxed.entries)
      {
        size = std::max(size, std::fabs(static_cast<double>(weight)));
      }
      for (const auto& parent : parents)
      {
        sum += parent.quanta;
        EXPECT_NE(parent.quanta, 0);
        EXPECT_LE(std::abs(parent.quanta), 127);
        const auto entry =
          std::ranges::find(relaxed.entries, parent.coarse, [](const auto& e) { return e.first; });
        ASSERT_NE(entry, relaxed.entries.end());
        // Rounding changes each by half a quantum, the largest one by that of all others.
        if (size < 1.0)
        {
          EXPECT_NEAR(parent.quanta, 127.0 * entry->second, 0.5 * test.operators.entries)
            << test.name << ", " << i;
        }
      }
      if (size < 1.0 && std::fabs(relaxed.sum) < 1.0)
      {
        EXPECT_NEAR(sum, 127.0 * relaxed.sum, 0.501) << test.name << ", node " << i;
      }
    }
  }
}

/** Rows with cancelling weights (slivers) have as many as on coarse levels. */
TEST(Interpolation, MayHaveFewerEntriesOnTheFinestLevel)
{
  const double cancelling = ExtendedInterpolation().coarsePoints.cancelling;
  std::size_t maxOfSlivers = 0;
  for (CoarseningCase& test : coarseningCases())
  {
    test.operators.finestEntries = 2;
    test.operators.entries = 3;
    for (const bool finest : { true, false })
    {
      test.level.finest = finest;
      std::size_t most[2] = { 0, 0 };
      const auto parents = coarsen(test.level, test.operators).record.parents;
      for (std::size_t i = 0; i < parents.size(); ++i)
      {
        double terms = 0.0, diagonal = test.level.rowSum[i];
        for (const RowEntry& entry : test.level.rows[i])
        {
          terms += std::fabs(entry.weight());
          diagonal += entry.weight();
        }
        std::size_t& own = most[terms > cancelling * diagonal ? 1 : 0];
        own = std::max(own, parents[i].size());
      }
      EXPECT_EQ(most[0], finest ? 2U : 3U) << test.name;
      maxOfSlivers = finest ? std::max(maxOfSlivers, most[1]) : maxOfSlivers;
    }
  }
  EXPECT_EQ(maxOfSlivers, 3U);
}

/** Next to stiff rows they have all that a row may have. */
TEST(Interpolation, HasMoreEntriesNextToStiffRows)
{
  const double scale = 1.0;
  const SliverRows rule(SliverRows::Triangles, scale);
  const TestLevel level = finestLevel(toStream(sliverChains(40, 30, 1e-3)), Weights::Cotangent, 17);
  RecordingOperators operators;
  operators.finestEntries = operators.entries = 2;
  const auto parents = coarsen(level, operators, 50, rule).record.parents;
  std::size_t most[2] = { 0, 0 };
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const bool isNext = std::ranges::any_of(level.rows[i], [&](const RowEntry& entry)
      { return level.least(i + entry.delta()) < SliverRows::Triangles; });
    most[isNext ? 1 : 0] = std::max(most[isNext ? 1 : 0], parents[i].size());
  }
  EXPECT_EQ(most[0], 2U);
  EXPECT_EQ(most[1], std::size_t(RelaxedRow::Most));
}

TEST(Interpolation, ReproducesConstantsWhereNothingIsConstrained)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    if (test.free)
    {
      const CoarsenedLevel step = coarsen(test.level, test.operators);
      for (const auto& parents : step.record.parents)
      {
        int quanta = 0;
        for (const auto& parent : parents)
        {
          quanta += parent.quanta;
        }
        ASSERT_EQ(quanta, 127) << test.name;
      }
    }
  }
}

} // namespace smg::testing
