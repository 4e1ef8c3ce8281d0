// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/MemoryGrowth.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/Isosurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

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

/** The solve fails with the first of many parts that has no room; what that one needed would not
 * suffice. */
TEST(MemoryLaw, TheErrorOfALowLimitNamesOneThatSuffices)
{
  for (const StreamMesh& mesh : { toStream(torus(632, 316)), toStream(tetBox(40, 40, 40)) })
  {
    ArrayProblem problem = heldEnds(mesh, 3, Weights::Cotangent);
    SolveOptions options;
    options.maxCycles = 2;
    options.threads = 1;
    const std::int64_t need = solveMesh(mesh, problem, options).report.pool_bytes_peak;
    for (const int threads : { 1, 4 })
    {
      options.threads = threads;
      for (const std::int64_t percent : { 1, 25, 50, 60, 70 })
      {
        options.memoryLimit = need * percent / 100;
        const std::string sentence = messageOf([&] { solveMesh(mesh, problem, options); });
        const std::string before = "(about ";
        const std::size_t place = sentence.find(before);
        ASSERT_NE(place, std::string::npos) << percent << " %: " << sentence;
        options.memoryLimit = std::stoll(sentence.substr(place + before.size())) << 20;
        EXPECT_EQ(messageOf([&] { solveMesh(mesh, problem, options); }), "") << sentence;
        EXPECT_LE(options.memoryLimit, 2 * need) << "more than is useful";
      }
    }
  }
}

/** Later passes leave out what is not necessary, several threads, the residuals of an acceleration
 * and at last its polynomials, too, where a limit has room for the first pass and little else;
 * only small meshes have to do without conjugate gradients. How they are accelerated, and so the
 * solution, does not depend on the threads. */
TEST(MemoryLaw, ALimitThatSufficesForTheFirstPassSufficesForAll)
{
  const std::pair<StreamMesh, int> cases[] = { { toStream(torus(316, 158)), 110 },
    { toStream(tetBox(40, 40, 40)), 103 }, { toStream(noisyGyroid(50, 0.02)), 103 } };
  for (const auto& [mesh, accelerated] : cases)
  {
    ArrayProblem problem = heldEnds(mesh, 3, Weights::Cotangent);
    SolveOptions options;
    options.coreNodes = 1000;
    options.threads = 1;
    options.maxCycles = 1;
    options.acceleration = AccelerationKind::None;
    const std::int64_t need = solveMesh(mesh, problem, options).report.pool_bytes_peak;
    options.maxCycles = 4;
    options.acceleration = AccelerationKind::ConjugateGradients;
    Report last;
    for (const int percent : { 103, 106, 110, 114, 120, 130, 150, 200 })
    {
      options.memoryLimit = need * percent / 100;
      options.threads = 1;
      last = solveMesh(mesh, problem, options).report;
      options.threads = 8;
      const Report ofMany = solveMesh(mesh, problem, options).report;
      EXPECT_LE(ofMany.pool_bytes_peak, options.memoryLimit);
      EXPECT_EQ(ofMany.acceleration, last.acceleration) << percent << " %";
      EXPECT_TRUE(percent < accelerated || last.acceleration == "cg") << percent << " %";
      EXPECT_EQ(ofMany.residuals, last.residuals) << percent << " %";
    }
    EXPECT_EQ(last.acceleration, "cg");
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
