// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

/**
 * The reduction of the residual per V-cycle: the geometric mean over the cycles after the first.
 */
double rateOf(const Report& report)
{
  const auto& r = report.residuals;
  return std::pow(r.back() / r.front(), 1.0 / static_cast<double>(r.size() - 1));
}

/**
 * Solves for the positions, prescribed at both ends in z, with initial values of zero elsewhere.
 */
Solved solveEnds(const IndexedTestMesh& mesh, Weights weights, double tolerance)
{
  const StreamMesh stream = toStream(mesh);
  ArrayProblem problem = fixedEnds(stream);
  problem.EdgeWeights = weights;
  return solveMesh(stream, problem, accurate(tolerance));
}

} // namespace

TEST(ConvergenceLaw, HardlyDependsOnTheSizeOfASurface)
{
  for (const Weights weights : { Weights::Uniform, Weights::Clamped })
  {
    double rates[2];
    for (const int k : { 0, 1 })
    {
      const int n = k == 0 ? 120 : 480;
      const Report report = solveEnds(torus(n, n / 2, 0.3), weights, 1e-10).report;
      EXPECT_TRUE(report.converged);
      rates[k] = rateOf(report);
      EXPECT_LT(rates[k], 0.35) << "torus of " << n;
      EXPECT_LE(report.cycles, 20);
    }
    EXPECT_LT(rates[1], rates[0] + 0.1);
  }
}

TEST(ConvergenceLaw, HardlyDependsOnTheSizeOfASolid)
{
  for (const Weights weights : { Weights::Uniform, Weights::Clamped })
  {
    double rates[2];
    for (const int k : { 0, 1 })
    {
      const int n = k == 0 ? 30 : 44;
      const Report report = solveEnds(tetBox(n, n, n, 0.15), weights, 1e-10).report;
      EXPECT_TRUE(report.converged);
      rates[k] = rateOf(report);
      EXPECT_LT(rates[k], 0.48) << "box of " << n;
      EXPECT_LE(report.cycles, 25);
    }
    EXPECT_LT(rates[1], rates[0] + 0.1);
  }
}

TEST(Convergence, NeedsFewCyclesForSixDigits)
{
  EXPECT_LE(solveEnds(torus(300, 150, 0.3), Weights::Uniform, 1e-6).report.cycles, 8);
  EXPECT_LE(solveEnds(torus(300, 150, 0.3), Weights::Clamped, 1e-6).report.cycles, 11);
  EXPECT_LE(solveEnds(tetBox(24, 24, 24, 0.15), Weights::Clamped, 1e-6).report.cycles, 14);
}

TEST(Convergence, MoreSweepsReduceTheErrorMore)
{
  const StreamMesh mesh = toStream(torus(120, 60, 0.3));
  ArrayProblem problem = fixedEnds(mesh);
  int cycles = 1000;
  double before = 1.0;
  for (const int sweeps : { 1, 2, 4, 8 })
  {
    SolveOptions options = accurate(1e-13);
    options.sweeps = sweeps;
    const Report report = solveMesh(mesh, problem, options).report;
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.cycles, cycles);
    cycles = report.cycles;
    EXPECT_LT(rateOf(report), before) << sweeps << " sweeps";
    before = rateOf(report);
  }
}

TEST(Convergence, TheReportedResidualIsTheTrueOne)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(80, 40, 0.3) : tetBox(14, 13, 12, 0.15));
    ArrayProblem problem = heldEnds(mesh, 2, Weights::Clamped);
    MemorySource source(mesh);
    const DirectSystem system = assembleDirect(source, problem);
    for (const int cycles : { 1, 2, 4 })
    {
      SolveOptions options = accurate(1e-13);
      options.maxCycles = cycles;
      const Solved solved = solveMesh(mesh, problem, options);
      // The weights of the engine have single precision, which limits the difference.
      const double expected = system.relativeResidual(solved.values);
      EXPECT_NEAR(solved.report.residuals.back(), expected, 1e-3 * expected + 1e-7);
    }
  }
}

TEST(Convergence, NotReachedIsSaid)
{
  const StreamMesh mesh = toStream(torus(80, 40, 0.3));
  ArrayProblem problem = fixedEnds(mesh);
  SolveOptions options = accurate();
  options.maxCycles = 2;
  const Report report = solveMesh(mesh, problem, options).report;
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(hasNote(report, "not converged"));
  EXPECT_GT(report.residuals.back(), options.tolerance);
}

TEST(Convergence, AnExactInitialGuessDoesNoHarm)
{
  const StreamMesh mesh = toStream(grid(50, 40, 0.1));
  // Linear functions solve the problem of a flat mesh with prescribed border.
  ArrayProblem problem = fixedEnds(mesh, 0.0, true);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    problem.Prescribed[v] = p[0] < 1.0 || p[0] > 48.0 || p[1] < 0.5 || p[1] > 33.0;
  }
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_LT(relativeError(solved.values, positionsOf(mesh)), 1e-6);
  EXPECT_TRUE(std::isfinite(solved.values.sum()));

  // A solution from zero is also kept if it is the initial guess.
  ArrayProblem again = heldEnds(mesh, 3, Weights::Uniform);
  const Solved first = solveMesh(mesh, again, accurate(1e-14));
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      again.Value[3 * v + k] = first.values(v, k);
    }
  }
  const Solved second = solveMesh(mesh, again, accurate(1e-6));
  EXPECT_TRUE(second.report.converged);
  EXPECT_LE(second.report.cycles, 3);
  EXPECT_LT(relativeError(second.values, first.values), 1e-12);
}

TEST(Convergence, ValuesFarFromZeroConvergeAsFarAsNumbersGo)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  for (const bool start : { false, true })
  {
    ArrayProblem problem = fixedEnds(mesh, 0.02, start);
    for (double& value : problem.Value)
    {
      value += 1e8;
    }
    const Solved solved = solveMesh(mesh, problem, accurate(1e-12));
    EXPECT_TRUE(solved.report.converged);
    const Eigen::MatrixXd expected = solveDirectly(mesh, problem);
    EXPECT_LT((solved.values - expected).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(Convergence, AnInitialGuessOfZerosWithZeroConstraintsIsTheSolution)
{
  const StreamMesh mesh = toStream(torus(40, 20));
  ArrayProblem problem;
  problem.Prescribed.resize(mesh.vertices());
  problem.Prescribed[7] = 1;
  const Solved solved = solveMesh(mesh, problem);
  EXPECT_TRUE(solved.report.converged);
  EXPECT_EQ(solved.report.cycles, 0);
  EXPECT_EQ(solved.report.passes, 1);
  EXPECT_EQ(solved.values.cwiseAbs().maxCoeff(), 0.0);
}

TEST(Convergence, ReachesTheDirectSolution)
{
  std::vector<IndexedTestMesh> meshes{ torus(120, 60, 0.4), sphere(5), grid(70, 50, 0.3),
    tetBox(16, 15, 14, 0.2) };
  int columns = 1;
  for (const IndexedTestMesh& mesh : meshes)
  {
    for (const Weights weights : { Weights::Uniform, Weights::Clamped })
    {
      for (const TestOrder order : { TestOrder::BreadthFirst, TestOrder::Keep })
      {
        const StreamMesh stream = toStream(shuffled(mesh), order);
        ArrayProblem problem = heldEnds(stream, columns, weights);
        const Solved solved = solveMesh(stream, problem, accurate());
        EXPECT_TRUE(solved.report.converged);
        EXPECT_LT(relativeError(solved.values, solveDirectly(stream, problem)), 1e-7)
          << columns << " columns, " << mesh.vertices() << " vertices";
        columns = columns % 5 + 1;
      }
    }
  }
}

} // namespace smg::testing
