// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/FreeComponents.h"
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

ArrayProblem randomSources(const StreamMesh& mesh, int columns, std::uint64_t seed)
{
  ArrayProblem problem;
  problem.Columns = columns;
  Random random(seed);
  for (std::int64_t i = 0; i < columns * mesh.vertices(); ++i)
  {
    problem.Source.push_back(random.uniform(-1, 1));
    problem.Value.push_back(random.uniform(3, 5));
  }
  return problem;
}

/** Subtracts a constant from each source so that M f sums to zero on the whole mesh. */
void makeCompatible(const StreamMesh& mesh, ArrayProblem& problem)
{
  MemorySource source(mesh);
  const Eigen::VectorXd mass = assembleDirect(source, problem).mass;
  for (int k = 0; k < problem.Columns; ++k)
  {
    double sum = 0.0;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      sum += mass[v] * problem.Source[problem.Columns * v + k];
    }
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      problem.Source[problem.Columns * v + k] -= sum / mass.sum();
    }
  }
}

/** The mean of values, one row per vertex, weighted by the masses. */
Eigen::RowVectorXd meanOf(
  const StreamMesh& mesh, ArrayProblem problem, const Eigen::MatrixXd& values)
{
  MemorySource source(mesh);
  const Eigen::VectorXd mass = assembleDirect(source, problem).mass;
  return mass.transpose() * values / mass.sum();
}

Eigen::RowVectorXd initialMean(const StreamMesh& mesh, const ArrayProblem& problem)
{
  return meanOf(mesh, problem,
    Eigen::Map<const Eigen::MatrixXd>(problem.Value.data(), problem.Columns, mesh.vertices())
      .transpose());
}

} // namespace

TEST(FreeComponents, PureNeumannProblemsKeepTheirMean)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(90, 45, 0.3) : tetBox(14, 13, 12, 0.15));
    for (const int columns : { 1, 3 })
    {
      ArrayProblem problem = randomSources(mesh, columns, 1);
      makeCompatible(mesh, problem);
      const Solved solved = solveMesh(mesh, problem, accurate());
      EXPECT_TRUE(solved.report.converged);
      EXPECT_EQ(solved.report.free_components, 1);
      EXPECT_TRUE(hasNote(solved.report, "mean of their initial values"));
      EXPECT_LT((meanOf(mesh, problem, solved.values) - initialMean(mesh, problem)).norm(), 1e-9);
      EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7);
    }
  }
}

TEST(FreeComponents, AnIncompatibleRightSideLosesItsMeanAndThatIsSaid)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(90, 45, 0.3) : tetBox(14, 13, 12, 0.15));
    ArrayProblem problem = randomSources(mesh, 2, 2);
    for (double& source : problem.Source)
    {
      source += 2.0;
    }
    for (const bool core : { false, true })
    {
      SolveOptions options = accurate();
      options.inCore = core;
      const Solved solved = solveMesh(mesh, problem, options);
      EXPECT_TRUE(solved.report.converged);
      EXPECT_TRUE(hasNote(solved.report, "do not sum to zero"));
      EXPECT_EQ(solved.report.warnings.size(), 1u);
      EXPECT_LT(solved.report.residuals.back(), 1e-10);
      EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7);
    }
  }
}

TEST(FreeComponents, WhatTheDiscretisationLeavesIsNoWarning)
{
  Report report;
  noteIncompatibility(report, 5e-4);
  EXPECT_TRUE(hasNote(report, "0.05 % of their size"));
  EXPECT_TRUE(report.warnings.empty());
}

TEST(FreeComponents, ACompatibleRightSideIsNotTouched)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem;
  problem.Target = [](const double* p, const double* q, double* d) { d[0] = p[0] - q[0]; };
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_TRUE(solved.report.converged);
  EXPECT_FALSE(hasNote(solved.report, "sum to zero"));
  const Eigen::MatrixXd x = positionsOf(mesh).col(0);
  EXPECT_LT(relativeError(solved.values, (x.array() - meanOf(mesh, problem, x)(0)).matrix()), 1e-8);
}

TEST(FreeComponents, AConstantSourceLeavesAConstant)
{
  // Graded: the triangles of the torus have different areas, and the box is stretched.
  StreamMesh box = toStream(tetBox(12, 11, 10, 0.15));
  for (std::size_t k = 0; k < box.positions.size(); k += 3)
  {
    box.positions[k] *= 1.0 + 0.3 * box.positions[k];
  }
  for (const StreamMesh& mesh : { toStream(sphere(0)), toStream(torus(200, 90, 0.4)), box })
  {
    for (const Weights weights : { Weights::Cotangent, Weights::Clamped, Weights::Uniform })
    {
      ArrayProblem problem;
      problem.EdgeWeights = weights;
      problem.Source.assign(mesh.vertices(), 3.0);
      problem.Value.assign(mesh.vertices(), 2.0);
      for (const bool core : { true, false })
      {
        SolveOptions options = accurate();
        options.inCore = core;
        options.coreNodes = 100;
        options.tolerance = 1e-14;
        const Solved solved = solveMesh(mesh, problem, options);
        EXPECT_TRUE(solved.report.converged);
        EXPECT_LT(solved.report.residuals.back(), 1e-12); // relative to the sources
        // No correction is that of sources with their mean, which have no solution.
        EXPECT_LT(solved.report.residuals.front(), 0.3);
        EXPECT_TRUE(hasNote(solved.report, "100 % of their size"));
        EXPECT_LT((solved.values.array() - 2.0).abs().maxCoeff(), 1e-11);
      }
    }
  }
}

TEST(FreeComponents, NothingGivenIsSolvedByTheMeanOfTheInitialValues)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = randomSources(mesh, 1, 3);
  problem.Source.clear();
  const Solved solved = solveMesh(mesh, problem, accurate());
  const double mean = initialMean(mesh, problem)[0];
  EXPECT_LT((solved.values.array() - mean).abs().maxCoeff(), 1e-8);

  problem.Value.assign(mesh.vertices(), 2.5);
  const Solved constant = solveMesh(mesh, problem, accurate());
  EXPECT_TRUE(constant.report.converged);
  EXPECT_LT((constant.values.array() - 2.5).abs().maxCoeff(), 1e-12);
}

TEST(FreeComponents, BesideConstrainedOnesOfAllSizes)
{
  // A constrained torus, a free sphere, a free single triangle, a constrained patch, in any order.
  IndexedTestMesh mesh = disjointUnion(torus(60, 30, 0.2), sphere(4), { 0, 0, 9 });
  const IndexedTestMesh triangle{ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1, 2 } };
  mesh = disjointUnion(mesh, triangle, { 0, 0, 19 });
  mesh = disjointUnion(mesh, grid(15, 12), { -3, 0, 29 });
  for (const TestOrder order : { TestOrder::BreadthFirst, TestOrder::Keep })
  {
    const StreamMesh stream = toStream(shuffled(mesh, 5), order);
    ArrayProblem problem = randomSources(stream, 2, 4);
    problem.Prescribed.resize(stream.vertices());
    for (std::int64_t v = 0; v < stream.vertices(); ++v)
    {
      const double x = stream.positions[3 * v];
      const double z = stream.positions[3 * v + 2];
      problem.Prescribed[v] = (z < 5 || z > 25) && x > 2.5;
    }
    for (const std::int64_t coreNodes : { 0, 50000 })
    {
      SolveOptions options = accurate(1e-11);
      options.coreNodes = coreNodes;
      const Solved solved = solveMesh(stream, problem, options);
      EXPECT_TRUE(solved.report.converged);
      EXPECT_EQ(solved.report.components, 4);
      EXPECT_EQ(solved.report.free_components, 2);
      EXPECT_LT(relativeError(solved.values, solveDirectly(stream, problem)), 1e-7);
    }
  }
}

TEST(FreeComponents, HundredsOfSmallOnes)
{
  IndexedTestMesh mesh;
  for (int k = 0; k < 400; ++k)
  {
    mesh = disjointUnion(mesh, k % 2 ? grid(3, 3) : sphere(0), { 10.0 * k, 0, 0 });
  }
  const StreamMesh stream = toStream(shuffled(mesh), TestOrder::Keep);
  ArrayProblem problem = randomSources(stream, 1, 5);
  const Solved solved = solveMesh(stream, problem, accurate());
  EXPECT_TRUE(solved.report.converged);
  EXPECT_EQ(solved.report.components, 400);
  EXPECT_EQ(solved.report.free_components, 400);
  EXPECT_LT(relativeError(solved.values, solveDirectly(stream, problem)), 1e-7);
}

TEST(FreeComponents, ScreeningConstrainsThem)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = randomSources(mesh, 1, 6);
  problem.Screening = 1e-3;
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_EQ(solved.report.free_components, 0);
  EXPECT_FALSE(hasNote(solved.report, "component"));
  EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7);
}

} // namespace smg::testing
