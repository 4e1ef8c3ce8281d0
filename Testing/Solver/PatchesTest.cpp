// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/Patches.h"
#include "Testing/Solver/CycleTesting.h"
#include "Testing/Solver/PatchReference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace smg::testing
{
namespace
{

std::vector<std::int64_t> membersOf(const Patches& patches, std::int64_t i)
{
  const Patch* patch = patches.of(i);
  std::vector<std::int64_t> members;
  for (int k = 0; patch && k < patch->size; ++k)
  {
    members.push_back(patch->member(k));
  }
  return patch ? members : std::vector<std::int64_t>{ i };
}

Eigen::MatrixXd denseOf(const PatchMatrix& matrix)
{
  return Eigen::MatrixXd::NullaryExpr(matrix.order, matrix.order,
    [&](Eigen::Index a, Eigen::Index b)
    { return matrix.at(static_cast<int>(a), static_cast<int>(b)); });
}

/** A path of nodes with these weights between consecutive nodes, and rowSum on every node. */
TestLevel path(const std::vector<float>& weights, double rowSum)
{
  TestLevel level;
  level.rows.resize(weights.size() + 1);
  level.rowSum.assign(level.rows.size(), rowSum);
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    level.rows[i].push_back({ 1, weights[i] });
    level.rows[i + 1].insert(level.rows[i + 1].begin(), RowEntry(-1, weights[i]));
  }
  return level;
}

/** Paths of 1, 2, .. 30 strongly coupled nodes, one behind the other, numbered at random. */
TestLevel shuffledPaths()
{
  std::vector<float> weights;
  for (int nodes = 1; nodes <= 30; ++nodes)
  {
    weights.insert(weights.end(), static_cast<std::size_t>(nodes - 1), 1.0F);
    weights.push_back(1e-3F);
  }
  const TestLevel paths = path(weights, -0.1);
  std::vector<std::int64_t> number(static_cast<std::size_t>(paths.nodes()));
  std::iota(number.begin(), number.end(), 0);
  Random random(5);
  for (std::size_t i = number.size() - 1; i > 0; --i)
  {
    std::swap(
      number[i], number[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(i) + 1))]);
  }
  TestLevel level;
  level.rows.resize(number.size());
  level.rowSum.assign(number.size(), -0.1);
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    auto& row = level.rows[static_cast<std::size_t>(number[i])];
    for (const RowEntry& entry : paths.rows[i])
    {
      const std::int64_t other = number[i + static_cast<std::size_t>(entry.delta())];
      row.push_back({ static_cast<std::int32_t>(other - number[i]), entry.weight() });
    }
    std::ranges::sort(row, {}, [](const RowEntry& entry) { return entry.delta(); });
  }
  return level;
}

/** The rows of a level in memory, and its patches. */
struct PatchedLevel
{
  explicit PatchedLevel(const TestLevel& level)
  {
    level.append(this->rows, 0, level.nodes());
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      this->patches.add(this->rows);
    }
  }

  Pool pool{ 1 << 28 };
  LevelRows rows{ pool };
  Patches patches{ pool };
};

} // namespace

TEST(Patches, JoinThoseOfStrongNeighboursThatHaveRoomWithinTheRings)
{
  std::vector<std::size_t> ofSize(Patch::Most + 1);
  std::int64_t further = 0;
  std::vector<TestLevel> levels = levelsWithPatches();
  levels.push_back(shuffledPaths());
  for (std::size_t k = 0; k < 2 * levels.size(); ++k)
  {
    const TestLevel& level = levels[k / 2];
    const int rings = k % 2 == 0 ? 1 : 2;
    Pool pool(1 << 28);
    LevelRows rows(pool);
    Patches patches(pool);
    patches.setRings(rings);
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      level.append(rows, i, i + 1);
      patches.add(rows);
    }
    const auto expected = patchesOf(level, rings);
    const auto reach = reachesOf(level);
    const Eigen::MatrixXd a = level.dense();
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      const auto members = membersOf(patches, i);
      ASSERT_EQ(members, expected[i]) << "node " << i;
      EXPECT_EQ(patches.last(i), members.back());
      const std::int64_t ring = reach[members.front()];
      EXPECT_LE(members.back(), rings == 1 ? ring : reach[ring]);
      further += members.back() > ring ? 1 : 0;
      EXPECT_EQ(patches.diagonal(i), static_cast<float>(rows.diagonal(i)));
      ++ofSize[members.size()];
      if (members.size() > 1)
      {
        EXPECT_LE(
          (denseOf(matrixOf(rows, *patches.of(i))) - partOf(a, members)).cwiseAbs().maxCoeff(),
          1e-12 * a(i, i));
      }
    }
  }
  for (std::size_t size = 1; size <= Patch::Most; ++size)
  {
    EXPECT_GE(ofSize[size], size) << size;
  }
  EXPECT_GT(further, 0);
}

TEST(Patches, AreOfCouplingsAboveStrong)
{
  // With weight 1 and rowSum on both nodes the coupling is 1 / (1 + rowSum).
  for (const bool strong : { true, false })
  {
    const TestLevel level =
      path({ 1.0F }, (strong ? 0.99 : 1.01) * (1.0 / Patches::StrongAlone - 1.0));
    Pool pool(1 << 24);
    LevelRows rows(pool);
    Patches patches(pool);
    for (std::int64_t i = 0; i < 2; ++i)
    {
      level.append(rows, i, i + 1);
      patches.add(rows);
    }
    EXPECT_EQ(patches.of(0) != nullptr, strong);
    EXPECT_EQ(patches.of(1), patches.of(0));
  }
}

TEST(Patches, UseTheWeightsInDoublePrecision)
{
  TestLevel level = path({ 1.0F }, 0.5);
  level.precise = { { 1.0 + 1e-9 }, { 1.0 + 1e-9 } };
  Pool pool(1 << 24);
  LevelRows rows(pool);
  Patches patches(pool);
  for (std::int64_t i = 0; i < 2; ++i)
  {
    level.append(rows, i, i + 1);
    patches.add(rows);
  }
  ASSERT_NE(patches.of(0), nullptr);
  const PatchMatrix matrix = matrixOf(rows, *patches.of(0));
  EXPECT_EQ(matrix.at(0, 1), -(1.0 + 1e-9));
  EXPECT_EQ(matrix.at(0, 0), 1.5 + 1e-9);
}

TEST(Patches, LetGoOfNodesKeepThePatchesOfTheOthers)
{
  const TestLevel level = levelsWithPatches()[0];
  const auto expected = patchesOf(level);
  PatchedLevel made(level);
  Patches& all = made.patches;
  for (std::int64_t first = 0; first < level.nodes(); first += 100)
  {
    all.release(first);
    for (std::int64_t i = first; i < level.nodes(); ++i)
    {
      ASSERT_EQ(membersOf(all, i), expected[i]);
    }
  }
}

TEST(PatchMatrices, AreThoseOfThePatchesUntilTheirFirstNodeIsReleased)
{
  const TestLevel level = levelsWithPatches()[0];
  PatchedLevel made(level);
  auto& [pool, rows, patches] = made;
  PatchMatrices matrices(pool);
  constexpr std::int64_t Lag = 70;
  std::int64_t compared = 0;
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    if (Patch* patch = patches.beginningAt(i))
    {
      EXPECT_EQ(matrices.append(rows, *patch), PatchMatrix::entriesOf(patch->size));
    }
    matrices.release(i - Lag);
    for (std::int64_t first = std::max<std::int64_t>(0, i - Lag); first <= i; ++first)
    {
      if (const Patch* patch = patches.beginningAt(first))
      {
        const PatchMatrix expected = matrixOf(rows, *patch);
        const int entries = PatchMatrix::entriesOf(patch->size);
        ASSERT_TRUE(std::equal(expected.entry, expected.entry + entries, matrices.of(*patch)));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, Lag);
}

/** However unevenly patches are spread: their stage must not fall behind the others. */
TEST(PatchMatrices, HaveRoomForOneOfEachNodeOfAStep)
{
  const TestLevel level = path(std::vector<float>(4000, 1.0F), -0.1);
  Pool pool(1 << 28);
  LevelRows rows(pool);
  level.append(rows, 0, level.nodes());
  Patch patch{ 0, 2, { 0, 1 }, 0 };
  PatchMatrices matrices(pool);
  for (std::int64_t step = 0; step < 10; ++step)
  {
    matrices.reserve(300, 3 * 300 + PatchMatrix::Entries);
    for (int k = 0; k < 300; ++k, patch.first += 1)
    {
      EXPECT_FALSE(matrices.isFull()) << step << ", " << k;
      matrices.append(rows, patch);
    }
    matrices.release(patch.first - 100);
  }
}

TEST(PatchMatrix, InvertsAsEigenDoes)
{
  for (int order = 1; order <= PatchMatrix::Most; ++order)
  {
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
    {
      const Eigen::MatrixXd root = randomMatrix(order, order, seed);
      const Eigen::MatrixXd a =
        root * root.transpose() + 1e-3 * Eigen::MatrixXd::Identity(order, order);
      PatchMatrix matrix;
      matrix.order = order;
      for (int i = 0; i < order; ++i)
      {
        for (int j = 0; j <= i; ++j)
        {
          matrix.at(i, j) = a(i, j);
        }
      }
      ASSERT_TRUE(matrix.invert(1e-9));
      const Eigen::MatrixXd expected = a.inverse();
      EXPECT_LT((denseOf(matrix) - expected).norm(), 1e-10 * expected.norm());
    }
  }
}

/** A separate component: a triangle that is nearly a needle. */
TEST(PatchMatrix, TheInverseOfASingularMatrixIsAGeneralisedOne)
{
  const double weights[3] = { 1e4, -0.3, 0.7 }; // of the edges 01, 02, 12
  PatchMatrix matrix;
  matrix.order = 3;
  std::ranges::copy(std::vector{ weights[0] + weights[1], -weights[0], weights[0] + weights[2],
                      -weights[1], -weights[2], weights[1] + weights[2] },
    matrix.entry);
  const Eigen::MatrixXd a = denseOf(matrix);
  EXPECT_FALSE(matrix.invert(1e-9));
  const Eigen::MatrixXd inverse = denseOf(matrix);
  EXPECT_EQ(inverse.row(2).norm(), 0.0); // the last node stays where it is
  EXPECT_LT((a * inverse * a - a).norm(), 1e-9 * a.norm());
}

TEST(PatchMatrix, TellsWhatIsNotPositiveDefiniteUpToRounding)
{
  const auto inverts = [](double last, double least)
  {
    PatchMatrix matrix;
    matrix.order = 2;
    matrix.at(0, 0) = 1.0;
    matrix.at(1, 0) = -1.0;
    matrix.at(1, 1) = last;
    return matrix.invert(least);
  };
  EXPECT_TRUE(inverts(1.0 + 1e-5, 1e-6));
  EXPECT_FALSE(inverts(1.0 + 1e-7, 1e-6));
  EXPECT_FALSE(inverts(1.0, 0.0));
  EXPECT_FALSE(inverts(0.5, 1e-6));
}

TEST(PatchMatrix, APowerOfTwoDoesNotMatter)
{
  PatchMatrix matrix;
  matrix.order = 3;
  std::ranges::copy(std::vector{ 1.7, -0.9, 1.3, 0.2, -0.7, 1.9 }, matrix.entry);
  PatchMatrix scaled = matrix;
  std::ranges::transform(scaled.entry, scaled.entry, [](double a) { return a / 8; });
  ASSERT_TRUE(matrix.invert(0.0) && scaled.invert(0.0));
  EXPECT_EQ(8 * denseOf(matrix), denseOf(scaled));
}

TEST(PatchMatrix, PartKeepsRowsAndColumns)
{
  PatchMatrix matrix;
  matrix.order = 4;
  std::iota(std::begin(matrix.entry), std::end(matrix.entry), 1.0);
  const int members[] = { 1, 3 };
  const Eigen::MatrixXd part = denseOf(matrix.part(members, 2));
  EXPECT_EQ(part, partOf(denseOf(matrix), { 1, 3 }));
}

} // namespace smg::testing
