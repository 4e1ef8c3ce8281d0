// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Progress.h"
#include "Solver/Core/CancelCheck.h"
#include "Solver/Core/Workers.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ProgressRecord.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace smg::testing
{

TEST(Progress, NeverDecreasesAndStopsWhenRefused)
{
  std::vector<double> seen;
  Progress progress(
    [&](double fraction)
    {
      seen.push_back(fraction);
      return seen.size() < 4;
    });
  progress.update(0.5);
  progress.update(0.2);
  progress.update(3.0);
  EXPECT_THROW(progress.update(1.0), Cancelled);
  EXPECT_EQ(seen, (std::vector<double>{ 0.5, 0.5, 1.0, 1.0 }));
  EXPECT_NO_THROW(Progress().update(0.5));
}

TEST(Progress, IsAskedInTheMiddleOfAPartOnAnyThread)
{
  using namespace std::chrono_literals;
  int asked = 0;
  CancelCheck check(
    [&]
    {
      if (++asked == 2)
      {
        throw Cancelled();
      }
    });
  check(); // too early to ask again
  EXPECT_EQ(asked, 0);
  std::this_thread::sleep_for(110ms);
  EXPECT_NO_THROW(check());
  EXPECT_EQ(asked, 1);
  Workers workers(2);
  workers.whileSleeping([&check] { check.whileSleeping(); });
  const auto work = [&check](int)
  {
    for (;; std::this_thread::sleep_for(1ms))
    {
      check();
    }
  };
  EXPECT_THROW(runAll(workers, 2, work), Cancelled);
  EXPECT_EQ(asked, 2);
  EXPECT_THROW(check(), Cancelled);
}

TEST(Progress, OfASolveRisesFromNearZeroToOne)
{
  const StreamMesh mesh = toStream(torus(120, 60, 0.3));
  ArrayProblem problem = fixedEnds(mesh);
  for (const bool core : { false, true })
  {
    for (const int maxCycles : { 1, 2, 50 })
    {
      ProgressRecord record;
      SolveOptions options;
      options.inCore = core;
      options.maxCycles = maxCycles;
      options.blockNodes = 500;
      options.coreNodes = 500;
      options.progress = record.function();
      solveMesh(mesh, problem, options, 200);
      record.expectRise(maxCycles == 50 ? 0.3 : 0.7);
    }
  }
}

} // namespace smg::testing
