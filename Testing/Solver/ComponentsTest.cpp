// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Components.h"
#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Storage/ScratchFolder.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace smg::testing
{
namespace
{

void count(Components& parts, std::int32_t label, double b, double x0)
{
  parts.count(label, &b, &x0);
}

} // namespace

TEST(Components, joinedLabelsHaveOneRoot)
{
  // Against the plainest way: relabel all.
  Components parts(1);
  Random random(2);
  std::vector<int> expected(300);
  std::iota(expected.begin(), expected.end(), 0);
  for (int i = 0; i < 300; ++i)
  {
    EXPECT_EQ(parts.add(), i);
  }
  for (int trial = 0; trial < 250; ++trial)
  {
    const auto a = static_cast<std::int32_t>(random.below(300));
    const auto b = static_cast<std::int32_t>(random.below(300));
    const std::int32_t whole = parts.join(a, b);
    EXPECT_EQ(parts.root(a), parts.root(whole));
    const int from = expected[a];
    const int to = expected[b];
    std::replace(expected.begin(), expected.end(), from, to);
    count(parts, a, 1.0, 0.0);
  }
  EXPECT_EQ(parts.components(),
    static_cast<std::int64_t>(std::set<int>(expected.begin(), expected.end()).size()));
  for (int a = 0; a < 300; ++a)
  {
    for (int b = 0; b < 300; b += 7)
    {
      EXPECT_EQ(parts.root(a) == parts.root(b), expected[a] == expected[b]);
    }
  }
}

TEST(Components, aConstraintAnywhereFixesTheWhole)
{
  Components parts(1);
  const std::int32_t a = parts.add();
  const std::int32_t b = parts.add();
  parts.add();
  EXPECT_EQ(parts.freeComponents(), 3);
  parts.anchor(b);
  EXPECT_EQ(parts.freeComponents(), 2);
  const std::int32_t whole = parts.join(a, b);
  EXPECT_FALSE(parts.isFree(parts.root(whole)));
  EXPECT_EQ(parts.freeComponents(), 1);
  EXPECT_EQ(parts.components(), 2);
}

TEST(Components, theMeanOfAnIncompatibleRightSideIsItsShift)
{
  Components parts(1);
  const std::int32_t free = parts.add();
  const std::int32_t other = parts.add();
  const std::int32_t fixed = parts.add();
  parts.anchor(fixed);
  count(parts, free, 3.0, 0.0);
  count(parts, other, 1.0, 0.0);
  const std::int32_t whole = parts.root(parts.join(free, other));
  count(parts, whole, -1.0, 0.0);
  count(parts, fixed, 100.0, 0.0);
  const std::vector<double> shifts = parts.rightSideShifts();
  EXPECT_DOUBLE_EQ(shifts[whole], 1.0);
  EXPECT_EQ(shifts[fixed], 0.0);
  EXPECT_DOUBLE_EQ(parts.incompatibleSquares(), 3.0);
}

TEST(Components, aRightSideThatSumsToZeroUpToRoundingIsLeftAlone)
{
  Components parts(1);
  const std::int32_t label = parts.add();
  for (const double b : { 0.1, 0.2, -0.3, 1e9, -1e9 })
  {
    count(parts, label, b, 0.0);
  }
  EXPECT_EQ(parts.incompatibleSquares(), 0.0);
}

TEST(Components, theMeanShiftRestoresTheInitialMean)
{
  Components parts(2);
  const std::int32_t label = parts.add();
  const double b[] = { 0.0, 0.0 };
  for (const double x : { 1.0, 2.0, 6.0 })
  {
    const double initial[] = { x, 10.0 * x };
    parts.count(label, b, initial);
  }
  const double sums[] = { 3.0, 150.0 };
  const std::vector<double> shifts = parts.meanShifts(sums);
  EXPECT_DOUBLE_EQ(shifts[0], -2.0);
  EXPECT_DOUBLE_EQ(shifts[1], 20.0);
}

TEST(ComponentLabels, areTheSameInMemoryAndInScratch)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  for (const std::int64_t vertices : { 1, 1023, 1024, 5000 })
  {
    ComponentLabels memory;
    ComponentLabels scratch;
    const ScratchFolder place(folder.path());
    scratch.useScratch(place.path(), statistics);
    std::vector<std::int32_t> labels(vertices);
    std::iota(labels.begin(), labels.end(), -1);
    for (std::int64_t first = 0; first < vertices; first += 300)
    {
      const auto part =
        std::span(labels).subspan(first, std::min<std::int64_t>(300, vertices - first));
      memory.append(part);
      scratch.append(part);
    }
    memory.finish();
    scratch.finish();
    EXPECT_EQ(scratch.vertices(), vertices);
    const std::int64_t blocks = (vertices + 1023) / 1024;
    for (const std::int64_t block : { blocks - 1, std::int64_t(0), blocks / 2 })
    {
      const auto a = memory.block(block);
      const auto b = scratch.block(block);
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
      EXPECT_EQ(b.front(), 1024 * block - 1);
    }
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ComponentLabels, blocksOfOneLabelKeepOne)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  const ScratchFolder place(folder.path());
  ComponentLabels labels;
  labels.useScratch(place.path(), statistics);
  std::vector<std::int32_t> given(3 * 1024 + 5, 7);
  given[1024] = -1;
  labels.append(given);
  labels.finish();
  EXPECT_EQ(statistics.bytesWritten, 4 * (1 + 1024 + 1 + 1));
  for (const std::int64_t block : { 1, 0, 3, 2 })
  {
    EXPECT_TRUE(std::ranges::equal(
      labels.block(block), std::span(given).subspan(1024 * block, block == 3 ? 5 : 1024)));
  }
}

} // namespace smg::testing
