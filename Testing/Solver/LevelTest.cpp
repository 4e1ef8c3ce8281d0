// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/Level.h"

#include "Solver/Multigrid/Cycle/RowShare.h"
#include "Testing/Solver/CycleTesting.h"
#include "Testing/Support/Combinations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace smg::testing
{
namespace
{

TestLevel surfaceLevel()
{
  return finestLevel(toStream(shuffled(torus(50, 24, 0.4))), Weights::Clamped, 37);
}

TestLevel solidLevel()
{
  return finestLevel(toStream(shuffled(tetBox(9, 8, 8, 0.15))), Weights::Clamped, 23);
}

/** Levels without patches and with many patches, some of which cross blocks. */
std::vector<TestLevel> levels()
{
  std::vector<TestLevel> levels = levelsWithPatches();
  levels.push_back(surfaceLevel());
  levels.push_back(solidLevel());
  return levels;
}

/** The share of each row of a finest level in the norm of the residual. */
Eigen::VectorXd sharesOf(const TestLevel& level)
{
  Eigen::VectorXd shares(level.nodes());
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    double edges = 0.0;
    for (const RowEntry& entry : level.rows[i])
    {
      edges += std::fabs(static_cast<double>(entry.weight()));
    }
    shares[i] = residualShare(commonShare(level.rowSum[i], edges));
  }
  return shares;
}

template <class Real>
bool sameState(const Ring<Real>& a, const Ring<Real>& b)
{
  return a.end() == b.end() && std::memcmp(a.at(0), b.at(0),
                                 sizeof(Real) * a.lanes() * static_cast<std::size_t>(a.end())) == 0;
}

} // namespace

TEST(Level, RelaxationIsForwardGaussSeidelWithPatchesSolvedFirst)
{
  Combinations chosen;
  for (const TestLevel& level : levels())
  {
    for (const int columns : { 1, 2, 3, 5, 8 })
    {
      if (!chosen.next())
      {
        continue;
      }
      DenseHierarchy<double> h(level, 2, columns, 3, columns == 5);
      const Eigen::MatrixXd b = randomMatrix(level.nodes(), columns, 1);
      setState(h.finest().window().b(), b);
      // The first sweep must take x as zero, independent of the memory.
      setState(h.finest().window().x(), randomMatrix(level.nodes(), columns, 7));
      h.finest().relaxDown();
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(level.nodes(), columns);
      for (int sweep = 0; sweep < 3; ++sweep)
      {
        denseSweep(h.matrix(0), sweep == 0 ? h.patches(0) : PatchList{}, b, expected);
      }
      EXPECT_LT(
        (stateOf(h.finest().window().x(), columns) - expected).cwiseAbs().maxCoeff(), 1e-12);

      setState(h.finest().window().x(), expected = randomMatrix(level.nodes(), columns, 2));
      h.finest().relaxUp();
      for (int sweep = 0; sweep < 3; ++sweep)
      {
        denseSweep(h.matrix(0), sweep == 0 ? h.patches(0) : PatchList{}, b, expected);
      }
      EXPECT_LT(
        (stateOf(h.finest().window().x(), columns) - expected).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

TEST(Level, RestrictionIsTheTransposeOfProlongation)
{
  for (const TestLevel& level : levels())
  {
    DenseHierarchy<double> h(level, 2, 1, 1);
    Ring<double>& x = h.finest().window().x();
    Ring<double>& b = h.finest().window().b();
    Ring<float>& coarseX = h.coarse(1).window().x();
    Ring<float>& coarseB = h.coarse(1).window().b();
    const Eigen::Index nodes = level.nodes();
    const Eigen::Index parents = h.matrix(1).rows();
    Eigen::MatrixXd prolongation(nodes, parents);
    for (Eigen::Index c = 0; c < parents; ++c)
    {
      setState(x, Eigen::VectorXd::Zero(nodes));
      setState(coarseX, Eigen::VectorXd::Unit(parents, c));
      h.finest().prolongAll();
      prolongation.col(c) = stateOf(x, 1);
    }
    EXPECT_LT((prolongation - h.interpolation(0)).cwiseAbs().maxCoeff(), 1e-7);

    Eigen::MatrixXd restriction(parents, nodes);
    setState(x, Eigen::VectorXd::Zero(nodes));
    for (Eigen::Index i = 0; i < nodes; ++i)
    {
      setState(b, Eigen::VectorXd::Unit(nodes, i));
      setState(coarseB, Eigen::VectorXd::Zero(parents));
      h.finest().restrictAll();
      restriction.col(i) = stateOf(coarseB, 1);
    }
    EXPECT_EQ(restriction, prolongation.transpose());
  }
}

TEST(Level, RestrictsTheResidualAndMeasuresIt)
{
  for (const TestLevel& level : levels())
  {
    for (const int columns : { 1, 3, 5 })
    {
      DenseHierarchy<double> h(level, 2, columns, 1);
      const Eigen::MatrixXd x = randomMatrix(level.nodes(), columns, 3);
      const Eigen::MatrixXd b = randomMatrix(level.nodes(), columns, 4);
      setState(h.finest().window().x(), x);
      setState(h.finest().window().b(), b);
      h.finest().restrictAll();
      const Eigen::MatrixXd residual = b - h.matrix(0) * x;
      const Eigen::VectorXd shares = sharesOf(level);
      const Eigen::MatrixXd expected = h.interpolation(0).transpose() * residual;
      EXPECT_LT((stateOf(h.coarse(1).window().b(), columns) - expected).cwiseAbs().maxCoeff(),
        1e-5 * expected.cwiseAbs().maxCoeff());
      for (int k = 0; k < columns; ++k)
      {
        const double squares = shares.cwiseProduct(residual.col(k)).squaredNorm();
        EXPECT_NEAR(h.finest().squares()[k], squares, 1e-12 * squares);
      }
    }
  }
}

TEST(Level, NarrowAndWideBlocksGiveTheSameBits)
{
  for (const TestLevel& level : levels())
  {
    for (const int columns : { 1, 5 })
    {
      DenseHierarchy<double> narrow(level, 2, columns, 2);
      DenseHierarchy<double> wide(level, 2, columns, 2, true);
      EXPECT_EQ(narrow.finest().window().header(0).wide, 0);
      EXPECT_EQ(wide.finest().window().header(0).wide, 1);
      const Eigen::MatrixXd correction = randomMatrix(narrow.matrix(1).rows(), columns, 6);
      for (auto* h : { &narrow, &wide })
      {
        setState(h->finest().window().b(), randomMatrix(level.nodes(), columns, 5));
        h->finest().relaxDown();
        h->finest().restrictAll();
        setState(h->coarse(1).window().x(), correction);
        h->finest().prolongAll();
        h->finest().relaxUp();
      }
      EXPECT_TRUE(sameState(narrow.finest().window().x(), wide.finest().window().x()));
      EXPECT_TRUE(sameState(narrow.coarse(1).window().b(), wide.coarse(1).window().b()));
      EXPECT_TRUE(std::ranges::equal(narrow.finest().squares(), wide.finest().squares()));
      EXPECT_TRUE(std::ranges::equal(narrow.finest().termSquares(), wide.finest().termSquares()));
    }
  }
}

TEST(RowBlockPacker, TurnsWideWhereADistanceOrACountDoesNotFit)
{
  Pool pool(1 << 28);
  SpareBuffers buffers(pool);
  const auto isWide = [&](std::int32_t distance, std::int64_t entries)
  {
    LevelRows rows(pool);
    RowEntry* row = rows.open(entries);
    for (std::int64_t e = 0; e < entries; ++e)
    {
      row[e] = { static_cast<std::int32_t>(distance - entries + 1 + e), 1.0F };
    }
    rows.close(entries, 0.0, -1);
    return packRows(buffers, rows, nullptr, 0, 1, false).header().wide != 0;
  };
  EXPECT_FALSE(isWide(32767, 1));
  EXPECT_TRUE(isWide(32768, 1));
  EXPECT_FALSE(isWide(32767, 32767));
  EXPECT_TRUE(isWide(70000, 70000));
}

/** The diagonal is that of an isolated node then, which makes every correction zero. */
TEST(LevelRows, CountRowsWhoseWeightsCancel)
{
  Pool pool(1 << 28);
  LevelRows rows(pool);
  const auto append = [&rows](double rowSum, const std::vector<RowEntry>& row)
  {
    std::ranges::copy(row, rows.open(static_cast<std::int64_t>(row.size())));
    rows.close(static_cast<std::int64_t>(row.size()), rowSum, -1);
  };
  append(0.0, {});
  append(0.0, { { -1, 2.0F }, { 1, -1.0F } });
  append(2.0, { { -1, -1.0F } });
  EXPECT_EQ(rows.frozen(), 0);
  append(0.0, { { -1, 1.0F }, { 1, -1.0F } });
  append(0.5, { { -1, -1.0F } });
  EXPECT_EQ(rows.frozen(), 2);
  for (std::int64_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(rows.diagonal(i) == nonZeroDiagonal(0.0), i == 0 || i > 2) << i;
  }
}

TEST(RowBlockPacker, WideBlocksKeepTheLargestDistances)
{
  constexpr auto Most = static_cast<std::int32_t>(RowEntry::MaxDistance);
  const std::vector<RowEntry> expected = { { -Most, 2.0F }, { -1, 3.0F }, { 1, 4.0F },
    { Most, 5.0F } };
  Pool pool(1 << 28);
  SpareBuffers buffers(pool);
  LevelRows rows(pool);
  for (int i = 0; i < 3; ++i)
  {
    std::ranges::copy(expected, rows.open(4));
    rows.close(4, 1.0, -1);
  }
  const RowBlock block = packRows(buffers, rows, nullptr, 0, 3, true);
  const RowBlock::Header& h = block.header();
  ASSERT_EQ(h.wide, 1);
  const auto a = block.arrays<WideIndex, BFloat16>();
  EXPECT_EQ(reinterpret_cast<const std::byte*>(a.diagonal), std::to_address(block.stored().end()));
  for (std::int64_t k = 0; k < 3; ++k)
  {
    const BlockRange row = entriesOf(h, a, k);
    ASSERT_EQ(row.end - row.begin, 4);
    for (std::int64_t e = 0; e < 4; ++e)
    {
      EXPECT_EQ(a.delta[row.begin + e], expected[e].delta());
      EXPECT_EQ(float(a.weight[row.begin + e]), expected[e].weight());
    }
    EXPECT_EQ(a.diagonal[k], 15.0);
  }
}

TEST(RowBlockPacker, WideBlocksKeepTheLargestDistancesOfParents)
{
  constexpr std::int64_t Base = std::int64_t(1) << 33;
  const std::vector<std::int64_t> parents = { 0, -40000, RowEntry::MaxDistance };
  Pool pool(1 << 28);
  SpareBuffers buffers(pool);
  LevelRows rows(pool), coarse(pool);
  CoarseningData coarsening(pool, rows, coarse);
  coarsening.coarseNodes = coarsening.interpolatedCoarse = Base + 100;
  for (int i = 0; i < 3; ++i)
  {
    rows.open(0);
    rows.close(0, 1.0, -1);
    coarsening.patches.add(rows);
    InterpolationEntry* entry = coarsening.interpolation.open(1);
    *entry = InterpolationEntry(static_cast<CoarseIndex>(Base + parents[i]), 10 - 20 * i);
    coarsening.interpolation.close(1);
    coarsening.parentReach.append(Base);
    coarsening.patchReach.append(i);
  }
  coarsening.parentReach.release(0); // the high bits of its values are those of the last one here
  const RowBlock block = packRows(buffers, rows, &coarsening, 0, 3, true);
  const RowBlock::Header& h = block.header();
  ASSERT_EQ(h.wide, 1);
  EXPECT_EQ(h.parentBase, Base);
  const auto a = block.arrays<WideIndex, BFloat16>();
  for (std::int64_t k = 0; k < 3; ++k)
  {
    const BlockRange parent = parentsOf(h, a, k);
    ASSERT_EQ(parent.end - parent.begin, 1);
    EXPECT_EQ(a.parent[parent.begin], parents[k]);
    EXPECT_EQ(a.parentQuanta[parent.begin], 10 - 20 * k);
  }
}

TEST(RowBlockPacker, KeepsRowsAndReaches)
{
  const TestLevel level = finestLevel(toStream(shuffled(grid(60, 40, 0.1))), Weights::Clamped);
  Pool pool(1 << 28);
  SpareBuffers buffers(pool);
  LevelRows rows(pool);
  level.append(rows, 0, level.nodes());
  for (std::int64_t first = 0; first < level.nodes(); first += RowBlock::Nodes)
  {
    const std::int64_t nodes = std::min(RowBlock::Nodes, level.nodes() - first);
    const RowBlock block = packRows(buffers, rows, nullptr, first, nodes, false);
    const RowBlock::Header& h = block.header();
    const auto a = block.arrays<std::int16_t, float>();
    EXPECT_EQ(
      reinterpret_cast<const std::byte*>(a.diagonal), std::to_address(block.stored().end()));
    EXPECT_EQ(block.end(), first + nodes);
    for (std::int64_t k = 0; k < nodes; ++k)
    {
      const BlockRange row = entriesOf(h, a, k);
      const auto& expected = level.rows[first + k];
      ASSERT_EQ(row.end - row.begin, static_cast<std::int64_t>(expected.size()));
      for (std::int64_t e = row.begin; e < row.end; ++e)
      {
        EXPECT_EQ(a.delta[e], expected[e - row.begin].delta());
        EXPECT_EQ(a.weight[e], expected[e - row.begin].weight());
        EXPECT_LE(first + k + a.delta[e], h.neighbourReach[k / RowBlock::Group]);
      }
      EXPECT_EQ(a.diagonal[k], rows.diagonal(first + k));
    }
  }
}

TEST(RowBlockPacker, KeepsPatchesAndPreciseRows)
{
  TestLevel level = levelsWithPatches()[0];
  Random random(11);
  level.precise.resize(level.nodes());
  for (std::int64_t i = 0; i < level.nodes(); i += 5)
  {
    for (const RowEntry& entry : level.rows[i])
    {
      level.precise[i].push_back(entry.weight() * (1.0 + 1e-9 * random.uniform(-1.0, 1.0)));
    }
  }
  const PatchList patches = patchesOf(level);
  const Eigen::MatrixXd matrix = level.dense();
  Pool pool(1 << 28);
  SpareBuffers buffers(pool);
  LevelRows rows(pool), coarse(pool);
  level.append(rows, 0, level.nodes());
  rows.Ended = true;
  Coarsening<RecordingOperators> step(pool, {}, rows, coarse);
  step.advance();
  std::int64_t across = 0;
  for (std::int64_t first = 0; first < level.nodes(); first += RowBlock::Nodes)
  {
    const std::int64_t nodes = std::min(RowBlock::Nodes, level.nodes() - first);
    const RowBlock block = packRows(buffers, rows, &step.data(), first, nodes, true);
    const RowBlock::Header& h = block.header();
    EXPECT_EQ(h.weightBytes, 4) << "rows of patches are not to be rounded";
    const auto a = block.arrays<std::int16_t, float>();
    EXPECT_EQ(
      reinterpret_cast<const std::byte*>(a.diagonal), std::to_address(block.stored().end()));
    const RowBlock::Special* special = a.special;
    for (std::int64_t i = first; i < block.end(); ++i)
    {
      const auto& patch = patches[i];
      const auto weights = level.preciseOf(i);
      EXPECT_NEAR(a.diagonal[i - first], matrix(i, i), 1e-14 * matrix(i, i));
      EXPECT_GE(h.reach((i - first) / RowBlock::Group, true), patch.back());
      EXPECT_EQ(h.reach((i - first) / RowBlock::Group, false),
        rows.reach(
          std::min(block.end(), first + ((i - first) / RowBlock::Group + 1) * RowBlock::Group) -
          1));
      if (patch.size() == 1 && weights.empty())
      {
        continue;
      }
      ASSERT_LT(special, a.special + h.specials);
      ASSERT_EQ(special->node, i - first);
      ASSERT_EQ(special->precise >= 0, !weights.empty());
      for (std::size_t e = 0; e < weights.size(); ++e)
      {
        EXPECT_EQ(a.precise[special->precise + e], weights[e]);
      }
      ASSERT_EQ(special->size, patch.size() == 1 ? 1 : patch.back() == i ? patch.size() : 0);
      if (special->size > 1)
      {
        const auto size = static_cast<int>(patch.size());
        const Eigen::MatrixXd inverse = partOf(matrix, patch).inverse();
        const double* value = a.value + special->value;
        for (int k = 0; k < size; ++k)
        {
          EXPECT_TRUE(k + 1 == size || value[k] == patch[k] - i);
          for (int l = 0; l <= k; ++l)
          {
            EXPECT_NEAR(value[size - 1 + PatchMatrix::place(k, l)], inverse(k, l),
              1e-5 * inverse.cwiseAbs().maxCoeff());
          }
        }
        across += patch.front() < first ? 1 : 0;
      }
      ++special;
    }
    EXPECT_EQ(special, a.special + h.specials);
  }
  EXPECT_GT(across, 0);
}

/** Weights that are equal in single precision. */
TEST(Level, SweepsAndResidualsUsePreciseWeights)
{
  TestLevel level = surfaceLevel();
  const Eigen::MatrixXd rough = level.dense();
  const Eigen::VectorXd shares = sharesOf(level);
  // Some rows are precise; of a patch, all or none.
  const PatchList patches = patchesOf(level);
  level.precise.resize(level.nodes());
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    for (const RowEntry& entry : level.rows[i])
    {
      if (patches[i].front() % 3 != 0)
      {
        break;
      }
      const auto low = static_cast<double>(std::min(i, i + entry.delta()));
      level.precise[i].push_back(entry.weight() * (1.0 + 2e-8 * std::sin(low)));
    }
  }
  for (const bool wide : { false, true })
  {
    for (const int columns : { 1, 4 })
    {
      DenseHierarchy<double> h(level, 2, columns, 1, wide);
      const Eigen::MatrixXd b = randomMatrix(level.nodes(), columns, 1);
      Eigen::MatrixXd x = randomMatrix(level.nodes(), columns, 2);
      setState(h.finest().window().x(), x);
      setState(h.finest().window().b(), b);
      h.finest().restrictAll();
      for (int k = 0; k < columns; ++k)
      {
        const auto squaresBy = [&](const Eigen::MatrixXd& matrix)
        { return shares.cwiseProduct((b - matrix * x).col(k)).squaredNorm(); };
        const double squares = squaresBy(h.matrix(0));
        EXPECT_NEAR(h.finest().squares()[k], squares, 1e-13 * squares);
        EXPECT_GT(std::fabs(squaresBy(rough) - squares), 1e-11 * squares);
      }
      h.finest().relaxUp();
      Eigen::MatrixXd other = x;
      denseSweep(h.matrix(0), h.patches(0), b, x);
      denseSweep(rough, h.patches(0), b, other);
      const Eigen::MatrixXd found = stateOf(h.finest().window().x(), columns);
      EXPECT_LT((found - x).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_GT((found - other).cwiseAbs().maxCoeff(), 1e-10);
    }
  }
}

} // namespace smg::testing
