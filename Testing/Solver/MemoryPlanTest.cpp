// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/MemoryPlan.h"

#include "Solver/Multigrid/Schedule/Schedule.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

// A test for each rule by which a memory limit decides.

namespace smg::testing
{
namespace
{

constexpr std::int64_t MiB = std::int64_t(1) << 20;
constexpr std::int64_t Coarsest = 1000;

StreamInfo surface(std::int64_t vertices, std::int64_t span)
{
  StreamInfo info;
  info.vertices = vertices;
  info.cells = 2 * vertices;
  info.span = span;
  return info;
}

SolveOptions within(std::int64_t limit, bool inCore = false)
{
  SolveOptions options;
  options.memoryLimit = limit;
  options.inCore = inCore;
  return options;
}

/** A plan after a first pass with this peak of memory, for the values of 20,000 nodes. */
class PlanAfterFirstPass
{
public:
  PlanAfterFirstPass(std::int64_t limit, std::int64_t peak)
    : plan(this->Memory, within(limit))
  {
    const Reservation used(this->Memory, peak);
    this->plan.endFirstPass(20000);
  }
  /** A plain pass with this peak. */
  void measure(std::int64_t peak)
  {
    this->Memory.restartPeak();
    const Reservation used(this->Memory, peak);
    this->plan.endPlainPass(20000);
  }

private:
  Pool Memory{ 1024 * MiB };

public:
  MemoryPlan plan;
};

} // namespace

TEST(MemoryPlan, TasksNeedALimitThatIsKnownToSuffice)
{
  const auto isAmple = [](const StreamInfo& info, std::int64_t limit)
  {
    const Pool pool(limit);
    MemoryPlan plan(pool, within(limit));
    plan.estimate(info, 1, Weights::Cotangent, within(limit));
    return plan.isAmple();
  };
  for (std::int64_t limit = MiB; limit < std::int64_t(1) << 40; limit *= 2)
  {
    // As in the worst order.
    EXPECT_EQ(isAmple(surface(1000000, -1), limit), isAmple(surface(1000000, 1000000), limit));
    EXPECT_FALSE(isAmple(surface(-1, -1), limit));
  }
  EXPECT_FALSE(isAmple(surface(1000000, 1000000), 16 * MiB));
  EXPECT_TRUE(isAmple(surface(1000000, 1000000), std::int64_t(1) << 40));
}

TEST(MemoryPlan, ExpectsMoreThanTheLeastForAnyThreads)
{
  for (const int columns : { 1, 4 })
  {
    for (const std::int64_t span : { 300, 30000 })
    {
      SolveOptions options = within(1024 * MiB);
      const StreamInfo info = surface(1000000, span);
      const Pool pool(options.memoryLimit);
      MemoryPlan plan(pool, options);
      options.threads = 1;
      plan.estimate(info, columns, Weights::Cotangent, options);
      const std::int64_t alone = plan.expected();
      EXPECT_GT(alone, leastMemory(info, columns, Weights::Cotangent, options));
      options.threads = 16;
      plan.estimate(info, columns, Weights::Cotangent, options);
      EXPECT_EQ(plan.expected(), alone);
      EXPECT_GT(expectedMemory(info, columns, Weights::Cotangent, options), alone);
    }
  }
  const Pool pool(MiB);
  MemoryPlan plan(pool, within(MiB));
  plan.estimate(surface(1000000, -1), 1, Weights::Cotangent, within(MiB));
  EXPECT_EQ(plan.expected(), 0); // unknown
}

TEST(MemoryPlan, CoreLevelsTakeAThirdOfTheLimit)
{
  const auto levelFor = [](std::int64_t vertices, const SolveOptions& options)
  {
    const Pool pool(options.memoryLimit);
    return MemoryPlan(pool, options).firstCoreLevel(vertices, Coarsest);
  };
  for (const std::int64_t vertices : { 1000, 100000, 10000000, 1000000000 })
  {
    int before = levelFor(vertices, within(4096 * MiB));
    for (std::int64_t limit = 2048 * MiB; limit >= MiB; limit /= 2)
    {
      const int level = levelFor(vertices, within(limit));
      // The same levels in core, whose results are the same.
      EXPECT_EQ(level, levelFor(vertices, within(limit, true)));
      EXPECT_GE(level, before);
      before = level;
      double nodes = 0.43 * static_cast<double>(vertices);
      for (int l = 1; l < level; ++l)
      {
        nodes *= 0.31;
      }
      EXPECT_TRUE(nodes * 200.0 <= static_cast<double>(limit) / 3.0 || nodes <= Coarsest);
    }
    SolveOptions few = within(4096 * MiB);
    few.coreNodes = 2000;
    EXPECT_GE(levelFor(vertices, few), levelFor(vertices, within(4096 * MiB)));
  }
  EXPECT_EQ(levelFor(500, within(1024 * MiB)), 1);
  EXPECT_GT(levelFor(-1, within(1024 * MiB)), 1);
}

TEST(MemoryPlan, ResidualsGiveWayBeforeSteps)
{
  // From the first limit that has room on, less never fits in more.
  constexpr std::int64_t Nodes = 1000000;
  int rank = 0;
  bool seen[3] = {};
  for (std::int64_t limit = 10 * MiB; limit < 20 * MiB; limit += MiB / 32)
  {
    const PlanAfterFirstPass after(limit, 10 * MiB);
    const std::optional<KeptResiduals> kept =
      after.plan.residualsThatFit(Nodes, 1, KeptResiduals::All);
    const int now = !kept ? 0 : *kept == KeptResiduals::Few ? 1 : 2;
    EXPECT_GE(now, rank);
    rank = now;
    seen[now] = true;
    EXPECT_EQ(!after.plan.hasRoom(Nodes, 1, KeptResiduals::All), now < 2);
    EXPECT_TRUE(now == 0 || after.plan.hasRoom(Nodes, 1, KeptResiduals::None));
  }
  EXPECT_TRUE(seen[0] && seen[1] && seen[2]);
}

TEST(MemoryPlan, WhatAPlainPassNeedsReplacesTheBoundOfTheFirstOne)
{
  constexpr std::int64_t Nodes = 1000000;
  PlanAfterFirstPass after(11 * MiB, 10 * MiB);
  EXPECT_FALSE(after.plan.hasRoom(Nodes, 1, KeptResiduals::All));
  after.measure(5 * MiB);
  EXPECT_TRUE(after.plan.hasRoom(Nodes, 1, KeptResiduals::All));
  after.measure(11 * MiB);
  EXPECT_FALSE(after.plan.hasRoom(Nodes, 1, KeptResiduals::None));
}

TEST(MemoryPlan, ChainsAndLongStepsNeedRoom)
{
  constexpr std::int64_t Nodes = 1000000;
  for (const int threads : { 1, 2, 16 })
  {
    int before = 1;
    for (std::int64_t limit = 10 * MiB; limit < 200 * MiB; limit += MiB)
    {
      const PlanAfterFirstPass after(limit, 10 * MiB);
      const MemoryPlan::Steps steps = after.plan.stepsOf(Nodes, 1, std::nullopt, threads);
      EXPECT_GE(steps.chains, 1);
      EXPECT_LE(steps.chains, Schedule::chainsFor(threads));
      EXPECT_GE(steps.nodes, after.plan.leastSteps().nodes);
      // Where the steps become longer there may be fewer chains, but no fewer than wanted.
      EXPECT_TRUE(steps.chains >= before || steps.chains == Schedule::chainsFor(threads));
      before = steps.chains;
      // Acceleration leaves less.
      EXPECT_LE(after.plan.stepsOf(Nodes, 1, 1, threads).chains, steps.chains);
    }
    EXPECT_EQ(before, Schedule::chainsFor(threads));
    const PlanAfterFirstPass tight(10 * MiB, 10 * MiB);
    EXPECT_EQ(tight.plan.stepsOf(Nodes, 1, 0, threads).chains, 1);
    EXPECT_EQ(tight.plan.stepsOf(Nodes, 1, 0, threads).nodes, tight.plan.leastSteps().nodes);
  }
}

} // namespace smg::testing
