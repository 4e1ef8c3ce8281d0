// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/MemoryGrowth.h"
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

// Memory grows with the width of the stream, not with the mesh: like the square root of the number
// of vertices for surfaces, and like its 2/3 power for solids.

namespace smg::testing
{
namespace
{

Report twoPasses(const StreamMesh& mesh)
{
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  SolveOptions options;
  options.maxCycles = 1;
  options.coreNodes = 1000;
  return solveMesh(mesh, problem, options).report;
}

} // namespace

/** More threads take more memory only if there is any. */
TEST(MemoryLaw, ALimitForOneThreadSufficesForMany)
{
  for (const StreamMesh& mesh : { toStream(torus(632, 316)), toStream(tetBox(40, 40, 40)) })
  {
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
    SolveOptions options;
    options.maxCycles = 2;
    options.coreNodes = 1000;
    options.threads = 1;
    options.memoryLimit = solveMesh(mesh, problem, options).report.pool_bytes_peak * 103 / 100;
    options.threads = 8;
    EXPECT_LE(solveMesh(mesh, problem, options).report.pool_bytes_peak, options.memoryLimit);
  }
}

/** Nothing accumulates where the mesh changes: prescribed vertices have no coarse nodes. */
TEST(MemoryLaw, ManyThreadsFollowAChangeOfTheMesh)
{
  const StreamMesh mesh = toStream(torus(632, 316));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  std::fill_n(problem.Prescribed.begin(), mesh.vertices() / 2, 1);
  const auto peak = [&](int threads)
  {
    SolveOptions options;
    options.maxCycles = 1;
    options.coreNodes = 1000;
    options.threads = threads;
    return solveMesh(mesh, problem, options).report.pool_bytes_peak;
  };
  EXPECT_LE(peak(4), peak(1) + (std::int64_t(3) << 20));
}

TEST(MemoryLaw, OfASurfaceIsTheSquareRoot)
{
  expectGrowth(twoPasses,
    { toStream(torus(316, 158)), toStream(torus(632, 316)), toStream(torus(1264, 632)) }, 2.2, 2.4);
}

TEST(MemoryLaw, OfASolidIsThePowerTwoThirds)
{
  // Ordered plane by plane. Coarse rows become longer with the number of levels, hence more bytes
  // per node.
  const auto planes = [](int n) { return toStream(tetBox(n, n, n), TestOrder::Keep); };
  expectGrowth(twoPasses, { planes(32), planes(64) }, 4.4, 6.5);
}

TEST(MemoryLaw, OfASolidInBreadthFirstOrderIsSublinear)
{
  // Its fronts are wide: most of the smaller box is in memory at once.
  expectGrowth(twoPasses, { toStream(tetBox(32, 32, 32)), toStream(tetBox(64, 64, 64)) }, 5.5, 6.5);
}

TEST(MemoryLaw, OfAStripIsItsWidth)
{
  // Independent of the length, except that every additional level keeps some blocks.
  expectGrowth(twoPasses, { toStream(grid(2000, 40)), toStream(grid(8000, 40)) }, 1.2, 1.25);
}

} // namespace smg::testing
