// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Hierarchy/Coarsening.h"
#include "Testing/Solver/HierarchyTesting.h"

#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

namespace smg::testing
{
namespace
{

struct Case
{
  std::string name;
  TestLevel level;
  RecordingOperators operators;
  bool free; ///< no constraint
};

/** Surfaces and tetrahedra, regular and not, with and without constraints. */
std::vector<Case> cases()
{
  const RecordingOperators surface;
  RecordingOperators solid;
  solid.strength = 0.0F;
  solid.finestEntries = solid.entries = 5;
  const auto uniform = Weights::Uniform;
  const auto cotangent = Weights::Clamped;
  const StreamMesh patch = toStream(shuffled(grid(24, 19, 0.3)));
  const StreamMesh ring = toStream(shuffled(torus(40, 16, 0.4)), TestOrder::Keep);
  const StreamMesh box = toStream(shuffled(tetBox(8, 7, 9, 0.15)));
  return {
    { "grid, uniform", finestLevel(patch, uniform), surface, true },
    { "grid, constrained", finestLevel(patch, cotangent, 9), surface, false },
    { "torus, cotangent", finestLevel(ring, cotangent), surface, true },
    { "torus, constrained", finestLevel(ring, uniform, 40), surface, false },
    { "box, cotangent", finestLevel(box, cotangent), solid, true },
    { "box, constrained", finestLevel(box, cotangent, 13), solid, false },
  };
}

/** What comes of the level of a case without sparsification. */
TestLevel product(const Case& test)
{
  RecordingOperators operators = test.operators;
  operators.tolerance = 0.0F;
  operators.record = std::make_shared<CoarseningRecord>();
  return coarsen(test.level, operators).coarse;
}

bool sameLevels(const TestLevel& a, const TestLevel& b)
{
  bool same = a.nodes() == b.nodes() && a.alpha == b.alpha;
  for (std::int64_t i = 0; same && i < a.nodes(); ++i)
  {
    same = std::equal(a.rows[i].begin(), a.rows[i].end(), b.rows[i].begin(), b.rows[i].end(),
      [](const RowEntry& x, const RowEntry& y)
      { return std::memcmp(&x, &y, sizeof(RowEntry)) == 0; });
  }
  return same;
}

/** The untruncated extended interpolation, from its formula. */
Eigen::MatrixXd extendedInterpolation(const CoarsenedLevel& step, float strength)
{
  const TestLevel& fine = step.fine;
  const auto& lifted = step.record.lifted;
  Eigen::MatrixXd initial = Eigen::MatrixXd::Zero(fine.nodes(), step.coarse.nodes());
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    double sum = fine.alpha[i];
    for (const RowEntry& entry : fine.rows[i])
    {
      const std::int64_t coarse = lifted[i + entry.delta()];
      if (coarse >= 0 && entry.weight() >= strength * fine.strongest(i))
      {
        initial(i, coarse) = entry.weight();
        sum += entry.weight();
      }
    }
    initial.row(i) /= sum > 0.0 ? sum : 1.0;
    if (lifted[i] >= 0)
    {
      initial.row(i).setZero();
      initial(i, lifted[i]) = 1.0;
    }
  }
  const Eigen::MatrixXd a = fine.dense();
  const Eigen::VectorXd diagonal = a.diagonal();
  Eigen::MatrixXd jacobi = diagonal.cwiseInverse().asDiagonal() * -a;
  jacobi.diagonal().setZero();
  Eigen::MatrixXd p = jacobi * initial;
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    if (lifted[i] >= 0)
    {
      p.row(i) = initial.row(i);
    }
  }
  return p;
}

} // namespace

TEST(Coarsening, liftedNodesAreAMaximalIndependentSetOfTheStrongEdges)
{
  for (const Case& test : cases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const auto& lifted = step.record.lifted;
    ASSERT_EQ(lifted.size(), test.level.rows.size());
    std::int64_t next = 0;
    for (std::int64_t i = 0; i < test.level.nodes(); ++i)
    {
      const float strong = test.operators.strength * test.level.strongest(i);
      bool dependsOnLifted = false;
      for (const RowEntry& entry : test.level.rows[i])
      {
        dependsOnLifted = dependsOnLifted || (entry.delta() < 0 && entry.weight() >= strong &&
                                               lifted[i + entry.delta()] >= 0);
      }
      const bool expected = !dependsOnLifted && !test.level.rows[i].empty();
      ASSERT_EQ(lifted[i], expected ? next : -1) << test.name << ", node " << i;
      next += expected ? 1 : 0;
    }
    EXPECT_EQ(next, step.coarse.nodes());
    EXPECT_LT(next, test.level.nodes() / 2);
  }
}

TEST(Coarsening, interpolationIsTheExtendedOneTruncatedAndRounded)
{
  for (const Case& test : cases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const Eigen::MatrixXd exact = extendedInterpolation(step, test.operators.strength);
    for (std::int64_t i = 0; i < test.level.nodes(); ++i)
    {
      const auto& parents = step.record.parents[i];
      ASSERT_LE(parents.size(), static_cast<std::size_t>(test.operators.entries)) << test.name;
      std::vector<double> row(exact.cols());
      Eigen::VectorXd::Map(row.data(), exact.cols()) = exact.row(i);
      std::sort(row.begin(), row.end(), std::greater<>());
      row.resize(std::min<std::size_t>(row.size(), test.operators.entries));
      const double kept = std::accumulate(row.begin(), row.end(), 0.0);
      const double sum = exact.row(i).sum();
      int quanta = 0;
      for (const auto& parent : parents)
      {
        quanta += static_cast<int>(parent.quanta);
        const double value = exact(i, parent.coarse);
        // Only the largest stay, but for ties; rounding moves each by half a quantum, the first
        // one by that of all others.
        EXPECT_GE(value, row.back() - 1e-6) << test.name;
        EXPECT_NEAR(
          parent.quanta / 255.0, value * sum / kept, 0.5 * test.operators.entries / 255.0);
      }
      EXPECT_NEAR(quanta, 255.0 * sum, 0.501) << test.name << ", node " << i;
      EXPECT_LE(quanta, 255);
    }
  }
}

TEST(Coarsening, theFinestLevelMayKeepFewerEntriesThanTheOthers)
{
  for (Case& test : cases())
  {
    test.operators.finestEntries = 2;
    test.operators.entries = 3;
    for (const bool finest : { true, false })
    {
      test.level.finest = finest;
      std::size_t most = 0;
      for (const auto& parents : coarsen(test.level, test.operators).record.parents)
      {
        most = std::max(most, parents.size());
      }
      EXPECT_EQ(most, finest ? 2U : 3U) << test.name;
    }
  }
}

TEST(Coarsening, interpolationReproducesConstantsWhereNothingIsConstrained)
{
  for (const Case& test : cases())
  {
    if (test.free)
    {
      const CoarsenedLevel step = coarsen(test.level, test.operators);
      for (const auto& parents : step.record.parents)
      {
        std::uint32_t quanta = 0;
        for (const auto& parent : parents)
        {
          quanta += parent.quanta;
        }
        ASSERT_EQ(quanta, 255U) << test.name;
      }
    }
  }
}

TEST(Coarsening, theRawProductIsTheGalerkinProduct)
{
  for (Case& test : cases())
  {
    test.operators.tolerance = 0.0F;
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const Eigen::MatrixXd p = step.record.interpolation();
    const Eigen::MatrixXd expected = p.transpose() * test.level.dense() * p;
    const Eigen::MatrixXd product = step.coarse.dense();
    EXPECT_EQ(product, product.transpose());
    // Entries keep 16 bits; row sums are floats on the way.
    EXPECT_LT((product - expected).cwiseAbs().maxCoeff(), 4e-5 * expected.maxCoeff()) << test.name;
    const Eigen::VectorXd rowSums = expected.rowwise().sum();
    for (std::int64_t c = 0; c < step.coarse.nodes(); ++c)
    {
      EXPECT_NEAR(step.coarse.alpha[c], rowSums[c], 1e-7 * expected(c, c)) << test.name;
    }
  }
}

TEST(Coarsening, rowSumsOfAFreeComponentAreZeroOnEveryLevel)
{
  for (const Case& test : cases())
  {
    TestLevel level = test.level;
    for (int depth = 0; test.free && level.nodes() > 3; ++depth)
    {
      for (const double alpha : level.alpha)
      {
        ASSERT_EQ(alpha, 0.0) << test.name << ", level " << depth;
      }
      ASSERT_LT(depth, 10);
      level = coarsen(level, test.operators).coarse;
    }
  }
}

TEST(Coarsening, sparsificationKeepsSymmetryAndRowSums)
{
  for (const Case& test : cases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const Eigen::MatrixXd sparse = step.coarse.dense();
    EXPECT_EQ(sparse, sparse.transpose()) << test.name;
    EXPECT_EQ(step.coarse.alpha, step.record.raw.alpha);
    const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(sparse).eigenvalues()[0];
    EXPECT_GT(smallest, test.free ? -1e-6 * sparse.maxCoeff() : 0.0) << test.name;
  }
}

TEST(Coarsening, sparsificationRemovesSmallEntriesThatCanGo)
{
  for (const Case& test : cases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const TestLevel raw = product(test);
    const Eigen::MatrixXd before = -raw.dense();
    const Eigen::MatrixXd after = -step.coarse.dense();
    const std::int64_t nodes = raw.nodes();
    const auto limit = [&](std::int64_t c, std::int64_t k)
    { return test.operators.tolerance * std::min(raw.strongest(c), raw.strongest(k)); };
    const auto isLarge = [&](std::int64_t c, std::int64_t k)
    { return c != k && std::fabs(before(c, k)) >= limit(c, k); };
    // Of a row that comes later than another one only what that one knows of it counts.
    const auto mayTake = [&](std::int64_t c, std::int64_t m)
    {
      const double least = m > c ? test.operators.tolerance * raw.strongest(c) : limit(c, m);
      return c != m && before(c, m) > 0 && before(c, m) >= least;
    };
    std::int64_t removed = 0;
    for (std::int64_t c = 0; c < nodes; ++c)
    {
      for (std::int64_t k = 0; k < c; ++k)
      {
        removed += before(c, k) != 0.0 && after(c, k) == 0.0 ? 1 : 0;
        if (isLarge(c, k))
        {
          // Large entries only take weight.
          EXPECT_GE(after(c, k), before(c, k)) << test.name;
          continue;
        }
        EXPECT_TRUE(after(c, k) == 0.0 || after(c, k) == before(c, k)) << test.name;
        EXPECT_GE(after(c, k), 0.0) << test.name;
        for (std::int64_t m = 0; after(c, k) != 0.0 && m < nodes; ++m)
        {
          EXPECT_FALSE(mayTake(c, m) && mayTake(k, m)) << test.name;
        }
      }
    }
    EXPECT_GT(removed, nodes / 4) << test.name;
  }
}

/** A row sum is what it was; the weight of a removed positive entry is found at its two neighbours.
 */
TEST(Coarsening, sparsificationDoesNotWeakenTheOperator)
{
  for (const Case& test : cases())
  {
    const CoarsenedLevel step = coarsen(test.level, test.operators);
    const Eigen::MatrixXd before = product(test).dense();
    const Eigen::MatrixXd after = step.coarse.dense();
    for (std::int64_t c = 0; c < step.coarse.nodes(); ++c)
    {
      EXPECT_GE(after(c, c), before(c, c) * (1.0 - 4e-5)) << test.name;
    }
  }
}

/** Meshes whose windows use the same memory for neighbours of a neighbour that are long gone. */
TEST(Coarsening, whatIsGoneIsNotLookedAt)
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

TEST(Coarsening, doesNotDependOnHowManyRowsComeAtOnce)
{
  for (const Case& test : cases())
  {
    const CoarsenedLevel whole = coarsen(test.level, test.operators);
    for (const std::int64_t batch : { 1, 7, 64, 200 })
    {
      const CoarsenedLevel parts = coarsen(test.level, test.operators, batch);
      EXPECT_EQ(parts.record.lifted, whole.record.lifted) << test.name;
      EXPECT_EQ(parts.record.parents, whole.record.parents) << test.name;
      EXPECT_TRUE(sameLevels(parts.record.raw, whole.record.raw)) << test.name;
      EXPECT_TRUE(sameLevels(parts.coarse, whole.coarse)) << test.name << ", batch " << batch;
    }
  }
}

TEST(Coarsening, stiffNodesStayAndTheirRowsAreNotSparsified)
{
  TestLevel level = finestLevel(toStream(sliverChains(40, 30, 1e-3)), Weights::Cotangent, 17);
  for (int l = 0; l < 3; ++l)
  {
    const CoarsenedLevel step = coarsen(level, {}, 50, StiffRows::Triangles);
    const TestLevel& raw = step.record.raw;
    std::int64_t stiff = 0, sparsified = 0;
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      const bool isStiff = level.least(i) < StiffRows::Triangles;
      stiff += isStiff ? 1 : 0;
      EXPECT_TRUE(!isStiff || step.record.lifted[i] >= 0);
    }
    EXPECT_GT(stiff, 100);
    EXPECT_TRUE(l > 0 || stiff < level.nodes() / 2);
    for (std::int64_t c = 0; c < raw.nodes(); ++c)
    {
      const bool fewer = step.coarse.rows[c].size() < raw.rows[c].size();
      EXPECT_FALSE(fewer && raw.least(c) < StiffRows::Triangles);
      sparsified += fewer ? 1 : 0;
    }
    EXPECT_TRUE(l > 0 || sparsified > 0);
    level = step.coarse;
    level.finest = false;
  }
}

TEST(Coarsening, nodesWithoutEdgesHaveNoParent)
{
  TestLevel level;
  level.rows = { {}, { { 2, 1.0F } }, {}, { { -2, 1.0F } }, {} };
  level.alpha = { 1.0, 0.0, 1.0, 0.5, 1.0 };
  for (const std::int64_t batch : { 1, 5 })
  {
    const CoarsenedLevel step = coarsen(level, {}, batch);
    EXPECT_EQ(step.record.lifted, (std::vector<std::int64_t>{ -1, 0, -1, -1, -1 }));
    EXPECT_TRUE(step.record.parents[0].empty());
    ASSERT_EQ(step.coarse.nodes(), 1);
    EXPECT_TRUE(step.coarse.rows[0].empty());
    EXPECT_GT(step.coarse.alpha[0], 0.0);
  }
}

TEST(Coarsening, ofALevelWithoutNodesIsOneWithoutNodes)
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

TEST(Coarsening, keepsAWindowOnly)
{
  // A long strip: the window is as wide as the strip, whatever its length.
  std::int64_t peak[2];
  for (const int length : { 200, 800 })
  {
    const TestLevel level = finestLevel(toStream(grid(length, 12)), Weights::Uniform);
    Pool pool(1 << 28);
    LevelRows fine(pool);
    LevelRows coarse(pool);
    Coarsening<RecordingOperators> step(pool, {}, fine, coarse);
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      level.append(fine, i, i + 1);
      step.advance();
      step.handOver();
      step.packed(step.interpolated());
      step.release();
      coarse.release(coarse.end(), coarse.end());
    }
    peak[length == 800] = pool.peak();
  }
  EXPECT_LT(peak[1], peak[0] + peak[0] / 10);
}

} // namespace smg::testing
