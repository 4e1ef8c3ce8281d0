// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Progress.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ProgressRecord.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace smg::testing
{
namespace
{

StreamMesh someTorus()
{
  return toStream(torus(120, 60, 0.3));
}

} // namespace

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

TEST(Progress, OfASolveRisesFromNearZeroToOne)
{
  const StreamMesh mesh = someTorus();
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

TEST(Progress, CancellingAnywhereLeavesNoScratchFile)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = someTorus();
  ArrayProblem problem = fixedEnds(mesh);
  for (const double limit : { 0.0, 0.05, 0.15, 0.3, 0.39, 0.45, 0.55, 0.7, 0.9, 1.0 })
  {
    SolveOptions options = accurate();
    options.scratch = folder.path();
    options.coreNodes = 500;
    bool refused = false;
    options.progress = [&](double fraction)
    {
      EXPECT_FALSE(refused);
      refused = fraction >= limit;
      return !refused;
    };
    EXPECT_THROW(solveMesh(mesh, problem, options, 200), Cancelled) << "at " << limit;
    EXPECT_TRUE(refused);
    EXPECT_EQ(folder.entries(), 0) << "cancelled at " << limit;
  }
}

TEST(Progress, AnExceptionOfTheCallbackPassesThrough)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = someTorus();
  ArrayProblem problem = fixedEnds(mesh);
  SolveOptions options;
  options.scratch = folder.path();
  options.progress = [](double fraction) -> bool
  { return fraction < 0.5 ? true : throw std::runtime_error("the caller's own"); };
  EXPECT_THROW(solveMesh(mesh, problem, options), std::runtime_error);
  EXPECT_EQ(folder.entries(), 0);
}

} // namespace smg::testing
