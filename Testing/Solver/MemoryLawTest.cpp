// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/Isosurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

// What a limit of memory, the threads and the passes of a solve have to do with one another.

namespace smg::testing
{

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
        const std::string before = " needs about ";
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
    const Report ample = solveMesh(mesh, problem, options).report;
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
      // What has other bits than without a limit says so.
      const bool isNoted = std::ranges::any_of(last.notes, [](const std::string& note)
        { return note.find("near what conjugate gradients need") != std::string::npos; });
      EXPECT_EQ(last.residuals != ample.residuals, isNoted || last.acceleration != "cg")
        << percent << " %";
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

} // namespace smg::testing
