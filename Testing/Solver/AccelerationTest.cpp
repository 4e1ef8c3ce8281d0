// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace smg::testing
{
namespace
{

constexpr AccelerationKind Kinds[] = { AccelerationKind::Chebyshev,
  AccelerationKind::ConjugateGradients };

const char* nameOf(AccelerationKind kind)
{
  return kind == AccelerationKind::Chebyshev ? "chebyshev" : "cg";
}

/** A surface or a solid with slowly converging V-cycles of one sweep, fixed at its ends. */
std::pair<StreamMesh, ArrayProblem> slowTask(bool surface, int columns)
{
  StreamMesh mesh =
    toStream(surface ? shuffled(torus(90, 50, 0.4)) : shuffled(tetBox(13, 12, 14, 0.15)));
  ArrayProblem problem = heldEnds(mesh, columns, Weights::Clamped);
  return { std::move(mesh), std::move(problem) };
}

SolveOptions oneSweep(AccelerationKind kind, double tolerance)
{
  SolveOptions options = accurate(tolerance);
  options.sweeps = 1;
  options.acceleration = kind;
  return options;
}

} // namespace

TEST(Acceleration, FindsTheSolution)
{
  for (const bool surface : { true, false })
  {
    auto [mesh, problem] = slowTask(surface, 3);
    const Eigen::MatrixXd direct = solveDirectly(mesh, problem);
    for (const AccelerationKind kind : Kinds)
    {
      const Solved solved = solveMesh(mesh, problem, oneSweep(kind, 1e-11));
      EXPECT_TRUE(solved.report.converged);
      EXPECT_EQ(solved.report.acceleration, nameOf(kind));
      EXPECT_LT((solved.values - direct).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

TEST(Acceleration, TheReportedResidualIsTheTrueOne)
{
  auto [mesh, problem] = slowTask(true, 2);
  MemorySource source(mesh);
  const DirectSystem system = assembleDirect(source, problem);
  for (const AccelerationKind kind : Kinds)
  {
    for (const int cycles : { 4, 6 })
    {
      SolveOptions options = oneSweep(kind, 1e-13);
      options.maxCycles = cycles;
      const Solved solved = solveMesh(mesh, problem, options);
      EXPECT_EQ(solved.report.passes, cycles + 1);
      const double expected = system.relativeResidual(solved.values);
      EXPECT_NEAR(solved.report.residuals.back(), expected, 1e-3 * expected + 1e-7);
    }
  }
}

TEST(Acceleration, NeedsFewerPassesWhereVCyclesAreSlow)
{
  // Elongated tetrahedra, many of them flat.
  IndexedTestMesh indexed = tetBox(13, 12, 14, 0.31);
  for (std::size_t k = 0; k < indexed.positions.size(); k += 3)
  {
    indexed.positions[k] *= 6.0;
  }
  const StreamMesh mesh = toStream(shuffled(indexed));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  const auto solveBy = [&](AccelerationKind kind)
  {
    SolveOptions options = oneSweep(kind, 1e-10);
    options.maxCycles = 200;
    const Report report = solveMesh(mesh, problem, options).report;
    EXPECT_TRUE(report.converged);
    return report;
  };
  const Report plain = solveBy(AccelerationKind::None);
  EXPECT_EQ(plain.acceleration, "none");
  ASSERT_GT(plain.residuals.back(), 0.5 * plain.residuals[plain.residuals.size() - 2])
    << "this is no slow problem";
  EXPECT_LT(solveBy(AccelerationKind::Chebyshev).passes, 0.7 * plain.passes);
  EXPECT_LT(solveBy(AccelerationKind::ConjugateGradients).passes, 0.55 * plain.passes);
  const Report automatic = solveBy(AccelerationKind::Automatic);
  EXPECT_LT(automatic.passes, 0.55 * plain.passes);
  EXPECT_EQ(automatic.acceleration, "cg");
}

TEST(Acceleration, IsNotBegunWhereFewVCyclesAreLeft)
{
  auto [mesh, problem] = slowTask(true, 1);
  SolveOptions options = accurate(1e-2);
  const Solved automatic = solveMesh(mesh, problem, options);
  EXPECT_EQ(automatic.report.acceleration, "none");
  options.acceleration = AccelerationKind::None;
  EXPECT_TRUE(sameBits(automatic.values, solveMesh(mesh, problem, options).values));
}

TEST(Acceleration, WithoutRoomForResidualsIsByPolynomials)
{
  auto [mesh, problem] = slowTask(true, 16);
  SolveOptions options = accurate(1e-8);
  options.inCore = true;
  options.coreNodes = 0; // otherwise the limit decides which levels are in memory
  options.acceleration = AccelerationKind::None;
  const Report plain = solveMesh(mesh, problem, options).report;
  options.acceleration = AccelerationKind::ConjugateGradients;
  options.memoryLimit = plain.pool_bytes_peak;
  const Solved solved = solveMesh(mesh, problem, options);
  EXPECT_TRUE(hasNote(solved.report, "Chebyshev polynomials accelerate instead"));
  EXPECT_EQ(solved.report.acceleration, "chebyshev");
  EXPECT_TRUE(solved.report.converged);
  EXPECT_LE(solved.report.cycles, plain.cycles);
  EXPECT_LE(solved.report.pool_bytes_peak, options.memoryLimit);
}

TEST(Acceleration, IsGivenUpWithoutRoomForItsVectors)
{
  const StreamMesh mesh = toStream(torus(316, 158));
  ArrayProblem problem = heldEnds(mesh, 3, Weights::Cotangent);
  SolveOptions options;
  options.coreNodes = 1000; // otherwise the limit decides which levels are in memory
  options.threads = 1;
  options.maxCycles = 4;
  options.acceleration = AccelerationKind::None;
  const Solved plain = solveMesh(mesh, problem, options);
  options.memoryLimit = plain.report.pool_bytes_peak * 103 / 100;
  for (const AccelerationKind kind : Kinds)
  {
    options.acceleration = kind;
    const Solved solved = solveMesh(mesh, problem, options);
    EXPECT_TRUE(hasNote(solved.report, "acceleration (chebyshev) was given up"));
    EXPECT_EQ(solved.report.acceleration, "none");
    EXPECT_TRUE(sameBits(solved.values, plain.values));
  }
}

} // namespace smg::testing
