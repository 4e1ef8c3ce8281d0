// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Files/ScratchFolder.h"
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

/** Counts a vertex with residual b. */
void count(Components& parts, std::int32_t label, double b, double x0, double mass = 1.0)
{
  parts.count(label, &b, &x0, &b, mass);
}

} // namespace

TEST(Components, JoinedLabelsHaveOneRoot)
{
  // Compared with the simplest method: relabelling all.
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

TEST(Components, AConstraintAnywhereFixesTheWhole)
{
  Components parts(1);
  const std::int32_t a = parts.add();
  const std::int32_t b = parts.add();
  parts.add();
  EXPECT_EQ(parts.freeComponents(), 3);
  parts.anchor(b);
  EXPECT_EQ(parts.freeComponents(), 2);
  const std::int32_t whole = parts.join(a, b);
  EXPECT_FALSE(parts.isFloating(parts.root(whole)));
  EXPECT_EQ(parts.freeComponents(), 1);
  EXPECT_EQ(parts.components(), 2);
}

TEST(Components, TheMeanOfAnIncompatibleRightSideIsItsShift)
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
  parts.settle();
  const std::vector<double> shifts = parts.rightSideShifts();
  EXPECT_DOUBLE_EQ(shifts[whole], 1.0);
  EXPECT_EQ(shifts[fixed], 0.0);
  EXPECT_DOUBLE_EQ(parts.shiftedSquares().front(), -3.0);
  EXPECT_DOUBLE_EQ(parts.shiftedSums()[0], 3.0);
  EXPECT_DOUBLE_EQ(parts.incompatibility(), 3.0 / 5.0);
}

TEST(Components, AConstantSourceIsAllMean)
{
  Components parts(1);
  const std::int32_t label = parts.add();
  double squares = 0.0;
  for (const double mass : { 0.5, 2.0, 8.0 })
  {
    count(parts, label, 3.0 * mass, 0.0, mass);
    squares += 9.0 * mass * mass;
  }
  parts.settle();
  EXPECT_DOUBLE_EQ(parts.rightSideShifts()[label], 3.0);
  EXPECT_DOUBLE_EQ(parts.shiftedSquares().front(), -squares);
  EXPECT_EQ(parts.weightOf(label, 0.5), 0.5);
}

TEST(Components, WhereNoVertexHasAMassAllCountAlike)
{
  Components parts(1);
  const std::int32_t label = parts.add();
  count(parts, label, 3.0, 7.0, 0.0);
  count(parts, label, 1.0, 9.0, 0.0);
  parts.settle();
  EXPECT_DOUBLE_EQ(parts.rightSideShifts()[label], 2.0);
  EXPECT_DOUBLE_EQ(parts.shiftedSquares().front(), -8.0);
  EXPECT_EQ(parts.weightOf(label, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(parts.meanShifts(std::vector{ 18.0 })[label], 1.0);
}

TEST(Components, AComponentThatIsHeldLooselyHasAConstant)
{
  Components parts(1);
  const std::int32_t first = parts.add(), second = parts.add();
  count(parts, first, 3.0, 0.5, 7.0); // in the interior: a mass, no row sum
  count(parts, first, 1.0, 2.0, -1e-12);
  count(parts, second, 4.0, 4.0, -3e-12);
  parts.hold(first, 1e-12, 1.0);
  parts.hold(second, 3e-12, 1.0);
  const std::int32_t whole = parts.root(parts.join(first, second));
  parts.anchorHeld();
  EXPECT_EQ(parts.freeComponents(), 0);
  EXPECT_EQ(parts.floatingComponents(), 1);
  EXPECT_TRUE(parts.shiftsRightSide());
  // Nothing is taken from the sources.
  EXPECT_EQ(parts.incompatibility(), 0.0);
  EXPECT_EQ(parts.shiftedSums()[0], 0.0);
  // The sum of b over that of the row sums.
  EXPECT_NEAR(parts.rightSideShifts()[whole], 2e12, 1e-3);
  EXPECT_EQ(parts.weightOf(whole, 7.0), 0.0);
  EXPECT_EQ(parts.weightOf(whole, -3e-12), 3e-12);
  std::vector<double> sums(2);
  // The iterates begin without the mean of the initial values, and the result has the constant
  // alone.
  EXPECT_DOUBLE_EQ(parts.initialMeans()[static_cast<std::size_t>(whole)], 3.5);
  sums[static_cast<std::size_t>(whole)] = 4e-12; // 1 above 0
  EXPECT_NEAR(parts.meanShifts(sums)[whole], 1.0 - 2e12, 1e-3);
}

TEST(Components, ManyLooseRowsAreNotLooseTogether)
{
  Components parts(1);
  const std::int32_t label = parts.add();
  for (int i = 0; i < 20000; ++i)
  {
    count(parts, label, 1.0, 0.0, -1e-7);
    parts.hold(label, 1e-7, 1.0);
  }
  parts.anchorHeld();
  EXPECT_EQ(parts.floatingComponents(), 0);
  EXPECT_FALSE(parts.shiftsRightSide());
}

TEST(Components, ARightSideThatSumsToZeroUpToRoundingIsLeftAlone)
{
  Components parts(1);
  const std::int32_t label = parts.add();
  for (const double b : { 0.1, 0.2, -0.3, 1e9, -1e9 })
  {
    count(parts, label, b, 0.0);
  }
  parts.settle();
  EXPECT_EQ(parts.incompatibility(), 0.0);
  EXPECT_EQ(parts.rightSideShifts()[label], 0.0);
}

TEST(Components, TheMeanShiftRestoresTheInitialMean)
{
  Components parts(2);
  const std::int32_t label = parts.add();
  const double b[] = { 0.0, 0.0 };
  for (const double x : { 1.0, 2.0, 6.0 })
  {
    const double initial[] = { x, 10.0 * x };
    parts.count(label, b, initial, b, x);
  }
  // Masses 1, 2, 6: the initial mean of the first column is 41 / 9.
  const double sums[] = { 5.0, 590.0 };
  const std::vector<double> shifts = parts.meanShifts(sums);
  EXPECT_DOUBLE_EQ(shifts[0], -4.0);
  EXPECT_DOUBLE_EQ(shifts[1], 20.0);
}

TEST(ComponentLabels, AreTheSameInMemoryAndInScratch)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  for (const std::int64_t vertices : { 1, 1023, 1024, 5000 })
  {
    Components parts(1);
    std::vector<std::int32_t> labels(vertices);
    std::vector<double> masses(vertices);
    for (std::int64_t v = 0; v < vertices; ++v)
    {
      labels[v] = v == 0 ? -1 : parts.add();
      masses[v] = 0.5 * static_cast<double>(v);
    }
    ComponentLabels memory(parts);
    ComponentLabels scratch(parts);
    const ScratchFolder place(folder.path());
    scratch.useScratch(place, statistics);
    for (std::int64_t first = 0; first < vertices; first += 300)
    {
      const auto count = std::min<std::int64_t>(300, vertices - first);
      memory.append(
        std::span(labels).subspan(first, count), std::span(masses).subspan(first, count));
      scratch.append(
        std::span(labels).subspan(first, count), std::span(masses).subspan(first, count));
    }
    memory.finish();
    scratch.finish();
    EXPECT_EQ(scratch.vertices(), vertices);
    const std::int64_t blocks = (vertices + 1023) / 1024;
    for (const std::int64_t block : { blocks - 1, std::int64_t(0), blocks / 2 })
    {
      const std::int64_t count = std::min<std::int64_t>(1024, vertices - 1024 * block);
      for (ComponentLabels* each : { &memory, &scratch })
      {
        const ComponentLabels::Entries entries = each->block(block);
        EXPECT_TRUE(
          std::ranges::equal(entries.labels, std::span(labels).subspan(1024 * block, count)));
        // A block without components has no masses.
        EXPECT_TRUE(vertices == 1 ? entries.masses.empty()
                                  : std::ranges::equal(entries.masses,
                                      std::span(masses).subspan(1024 * block, count)));
      }
    }
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ComponentLabels, BlocksOfOneLabelKeepOneAndMassesOnlyOfFreeOnes)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  const ScratchFolder place(folder.path());
  Components parts(1);
  const std::int32_t held = parts.add();
  const std::int32_t free = parts.add();
  parts.anchor(held);
  ComponentLabels labels(parts);
  labels.useScratch(place, statistics);
  std::vector<std::int32_t> given(3 * 1024 + 5, held);
  given[1024] = -1;
  std::ranges::fill(std::span(given).last(5), free);
  const std::vector<double> masses(given.size(), 0.25);
  labels.append(given, masses);
  labels.finish();
  EXPECT_EQ(statistics.bytesWritten, 4 * (1 + 1024 + 1 + 1) + 8 * 5);
  for (const std::int64_t block : { 1, 0, 3, 2 })
  {
    const ComponentLabels::Entries entries = labels.block(block);
    const std::size_t count = block == 3 ? 5 : 1024;
    EXPECT_TRUE(std::ranges::equal(entries.labels, std::span(given).subspan(1024 * block, count)));
    EXPECT_EQ(entries.masses.size(), block == 3 ? 5 : 0);
  }
}

} // namespace smg::testing
