// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/CoarseningTesting.h"
#include "Testing/Support/Combinations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace smg::testing
{
namespace
{

/** Sparsification of dense rows by its definition, pair by pair in stream order. */
class DenseSparsification
{
public:
  DenseSparsification(const CoarseningRecord& record, const RecordingOperators& operators)
    : Raw(record.raw)
    , Tolerance(operators.tolerance)
    , DropsNegative(operators.dropsNegative)
    , Before(Eigen::MatrixXf::Zero(Raw.nodes(), Raw.nodes()))
    , After(Before)
  {
    for (std::int64_t c = 0; c < this->Raw.nodes(); ++c)
    {
      double terms = 0.0;
      for (const RowEntry& entry : this->Raw.rows[c])
      {
        this->Before(c, c + entry.delta()) = entry.weight();
        terms += std::fabs(entry.weight());
      }
      // The weight in the upper row of a pair counts.
      this->After.row(c).tail(this->Raw.nodes() - c) =
        this->Before.row(c).tail(this->Raw.nodes() - c);
      this->Kept.push_back(
        record.rawStiff[c] || terms > operators.cancelling * this->Raw.diagonal(c));
    }
    for (std::int64_t k = 0; k < this->Raw.nodes(); ++k)
    {
      this->treat(k);
    }
  }

  /** The weight of a pair, 0 if there is none. */
  float weight(std::int64_t c, std::int64_t k) const
  {
    return this->After(std::min(c, k), std::max(c, k));
  }
  bool kept(std::int64_t c) const { return this->Kept[c]; }
  std::int64_t removed = 0, moved = 0, dropped = 0; ///< of these: negative ones
  std::int64_t stayed = 0; ///< small negative ones without a common neighbour

private:
  void treat(std::int64_t k)
  {
    for (std::int64_t c = 0; c < k; ++c)
    {
      const double weight = this->Before(k, c);
      if (weight * weight > 0.25 * this->Raw.diagonal(c) * this->Raw.diagonal(k))
      {
        this->Kept[c] = this->Kept[k] = true;
      }
    }
    for (std::int64_t c = 0; c < k && !this->Kept[k]; ++c)
    {
      const float weight = this->After(c, k);
      const bool small = std::fabs(weight) <
                         this->Tolerance * std::min(this->Raw.strongest(c), this->Raw.strongest(k));
      if (weight == 0.0F || this->Kept[c] || this->large(k, c) || !small)
      {
        continue;
      }
      const std::int64_t middle = this->middle(c, k, std::max(0.0F, -2.0F * weight));
      if (middle < 0 && !(this->DropsNegative && weight < 0.0F))
      {
        this->stayed += weight < 0.0F ? 1 : 0;
        continue;
      }
      if (middle >= 0)
      {
        this->After(std::min(c, middle), std::max(c, middle)) += weight;
        this->After(std::min(k, middle), std::max(k, middle)) += weight;
      }
      this->After(c, k) = 0.0F;
      ++this->removed;
      this->moved += weight < 0.0F && middle >= 0 ? 1 : 0;
      this->dropped += weight < 0.0F && middle < 0 ? 1 : 0;
    }
  }

  /** Whether the entry of row c and column m is large, as seen from row c. */
  bool large(std::int64_t c, std::int64_t m) const
  {
    const float weight = this->Before(c, m);
    return weight != 0.0F &&
           std::fabs(weight) >= this->Tolerance * std::min(this->Raw.strongest(c),
                                                    this->Raw.strongest(std::min(c, m)));
  }

  std::int64_t middle(std::int64_t c, std::int64_t k, float best) const
  {
    std::int64_t middle = -1;
    for (std::int64_t m = 0; m < this->Raw.nodes(); ++m)
    {
      if (m == c || m == k || !this->large(c, m) || !this->large(k, m))
      {
        continue;
      }
      const float own = m < c ? this->Before(c, m) : this->After(c, m);
      const float weight = std::min(own, this->Before(k, m));
      if (weight > best)
      {
        best = weight;
        middle = m;
      }
    }
    return middle;
  }

  const TestLevel& Raw;
  float Tolerance;
  bool DropsNegative;
  Eigen::MatrixXf Before, After;
  std::vector<bool> Kept;
};

} // namespace

TEST(Sparsification, AnOverflowIsNotARemovedEntry)
{
  const float infinity = std::numeric_limits<float>::infinity();
  volatile float overflow = infinity;
  for (const float weight : { overflow - overflow, std::numeric_limits<float>::quiet_NaN(),
         -std::numeric_limits<float>::quiet_NaN() })
  {
    CoarseEntry entry(5, weight);
    EXPECT_FALSE(entry.removed());
    CoarseEntry copy(6, 1.0F);
    copy.takeValue(entry);
    EXPECT_FALSE(copy.removed());
    EXPECT_TRUE(std::isnan(copy.value()));
    entry.remove();
    copy.takeValue(entry);
    EXPECT_TRUE(entry.removed() && copy.removed());
  }
}

TEST(Sparsification, FollowsItsRuleToTheBit)
{
  for (const bool dropsNegative : { false, true })
  {
    std::int64_t moved = 0, dropped = 0, stayed = 0, kept = 0;
    for (const CoarseningCase& test : coarseningCases())
    {
      RecordingOperators operators = test.operators;
      operators.dropsNegative = dropsNegative;
      const CoarsenedLevel step = coarsen(test.level, operators);
      const DenseSparsification expected(step.record, operators);
      for (std::int64_t c = 0; c < step.coarse.nodes(); ++c)
      {
        std::vector<float> row(step.coarse.nodes());
        for (const RowEntry& entry : step.coarse.rows[c])
        {
          row[c + entry.delta()] = entry.weight();
        }
        for (std::int64_t k = 0; k < step.coarse.nodes(); ++k)
        {
          ASSERT_EQ(row[k], k == c ? 0.0F : expected.weight(c, k))
            << test.name << ", " << c << ", " << k;
        }
        kept += expected.kept(c) ? 1 : 0;
      }
      EXPECT_TRUE(!test.positive || expected.removed > step.coarse.nodes() / 4) << test.name;
      moved += expected.moved;
      dropped += expected.dropped;
      stayed += expected.stayed;
    }
    EXPECT_GT(moved, 20);
    EXPECT_GT(dropsNegative ? dropped : stayed, 20);
    EXPECT_GT(kept, 20);
  }
}

TEST(Sparsification, KeepsSymmetryAndRowSums)
{
  Combinations chosen;
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const Eigen::MatrixXd sparse = step.coarse.dense();
    EXPECT_EQ(sparse, sparse.transpose()) << test.name;
    EXPECT_EQ(step.coarse.rowSum, step.record.raw.rowSum);
    if (!chosen.next())
    {
      continue; // the rest is a computation of the test alone
    }
    const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(sparse).eigenvalues()[0];
    EXPECT_GT(smallest, test.free ? -1e-6 * sparse.maxCoeff() : 0.0) << test.name;
  }
}

TEST(Sparsification, LeavesRowsAloneWhoseWeightsCancel)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const TestLevel& raw = step.record.raw;
    for (std::int64_t c = 0; c < raw.nodes(); ++c)
    {
      double terms = 0.0;
      for (const RowEntry& entry : raw.rows[c])
      {
        terms += std::fabs(entry.weight());
      }
      if (terms > test.operators.cancelling * raw.diagonal(c) * (1.0 + 1e-6))
      {
        EXPECT_EQ(step.coarse.rows[c].size(), raw.rows[c].size()) << test.name << ", " << c;
      }
    }
  }
}

} // namespace smg::testing
