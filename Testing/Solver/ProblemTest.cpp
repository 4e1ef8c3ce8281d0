// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Problem.h"
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace smg::testing
{
namespace
{

using Function = std::function<double(double, double, double)>;

/** f at all vertices. */
Eigen::MatrixXd sample(const StreamMesh& mesh, const Function& f)
{
  Eigen::MatrixXd values(mesh.vertices(), 1);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    values(v) = f(p[0], p[1], p[2]);
  }
  return values;
}

/** -Laplace u = f with u prescribed within `margin` of the border of the bounds. */
ArrayProblem manufactured(
  const StreamMesh& mesh, const Function& u, const Function& f, double margin)
{
  ArrayProblem problem;
  const Eigen::MatrixXd positions = positionsOf(mesh);
  const Eigen::RowVector3d low = positions.colwise().minCoeff();
  const Eigen::RowVector3d high = positions.colwise().maxCoeff();
  const Eigen::MatrixXd value = sample(mesh, u);
  const Eigen::MatrixXd source = sample(mesh, f);
  problem.Source.assign(source.data(), source.data() + source.size());
  problem.Value.resize(mesh.vertices());
  problem.Prescribed.resize(mesh.vertices());
  const int dimensions = mesh.cellType == CellType::Triangle ? 2 : 3;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < dimensions; ++k)
    {
      const double p = positions(v, k);
      problem.Prescribed[v] = problem.Prescribed[v] || p < low[k] + margin || p > high[k] - margin;
    }
    problem.Value[v] = problem.Prescribed[v] ? value(v) : 0.0;
  }
  return problem;
}

void scale(IndexedTestMesh& mesh, double factor)
{
  for (double& p : mesh.positions)
  {
    p *= factor;
  }
}

} // namespace

TEST(Problem, LinearFunctionsOnAFlatMeshAreExact)
{
  const StreamMesh mesh = toStream(shuffled(grid(60, 50, 0.08)));
  const Function u = [](double x, double y, double) { return 3 - 2 * x + 0.5 * y; };
  const Eigen::MatrixXd exact = sample(mesh, u);
  ArrayProblem problem;
  problem.Prescribed.resize(mesh.vertices());
  problem.Value.resize(mesh.vertices());
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double x = mesh.positions[3 * v];
    const double y = mesh.positions[3 * v + 1];
    problem.Prescribed[v] = x < 1 || x > 58 || y < 0.5 || y > 41.5;
    problem.Value[v] = problem.Prescribed[v] ? exact(v) : 0.0;
  }
  const Solved solved = solveMesh(mesh, problem, accurate(1e-13));
  EXPECT_EQ(solved.report.clamped_weights, 0);
  // Up to the rounding of the weights to single precision.
  EXPECT_LT(relativeError(solved.values, exact), 1e-7);
}

TEST(Problem, LinearFunctionsOnARegularMeshAreExactToNineDigits)
{
  // All weights of an equilateral mesh are equal, also after rounding.
  const StreamMesh mesh = toStream(grid(60, 50));
  const Function u = [](double x, double y, double) { return 3 - 2 * x + 0.5 * y; };
  const Eigen::MatrixXd exact = sample(mesh, u);
  for (const Weights weights : { Weights::Uniform, Weights::Clamped })
  {
    ArrayProblem problem;
    problem.EdgeWeights = weights;
    problem.Prescribed.resize(mesh.vertices());
    problem.Value.resize(mesh.vertices());
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      const double x = mesh.positions[3 * v];
      const double y = mesh.positions[3 * v + 1];
      problem.Prescribed[v] = x < 0.75 || x > 58.75 || y < 0.5 || y > 42.0;
      problem.Value[v] = problem.Prescribed[v] ? exact(v) : 0.0;
    }
    const Solved solved = solveMesh(mesh, problem, accurate(1e-13));
    EXPECT_LT(relativeError(solved.values, exact), 1e-9);
  }
}

TEST(Problem, ASmoothSolutionOnAGridIsApproachedWithSecondOrder)
{
  const double pi = std::numbers::pi;
  const Function u = [pi](double x, double y, double)
  { return std::sin(pi * x) * std::cos(pi * y); };
  const Function f = [&](double x, double y, double z) { return 2 * pi * pi * u(x, y, z); };
  double errors[3];
  for (const int k : { 0, 1, 2 })
  {
    const int n = 16 << k;
    IndexedTestMesh flat = grid(n + 1, n + 1);
    scale(flat, 1.0 / n);
    const StreamMesh mesh = toStream(flat);
    // Every other row begins half an edge later.
    ArrayProblem problem = manufactured(mesh, u, f, 0.75 / n);
    const Solved solved = solveMesh(mesh, problem, accurate());
    errors[k] = relativeError(solved.values, sample(mesh, u));
  }
  EXPECT_LT(errors[2], 2e-3);
  EXPECT_GT(errors[0] / errors[1], 3.0);
  EXPECT_GT(errors[1] / errors[2], 3.0);
}

TEST(Problem, ASmoothSolutionInABoxIsApproachedWithSecondOrder)
{
  const Function u = [](double x, double y, double z)
  { return std::sin(2 * x) * std::exp(y) + z * z * x; };
  const Function f = [](double x, double y, double)
  { return 3 * std::sin(2 * x) * std::exp(y) - 2 * x; };
  double errors[3];
  for (const int k : { 0, 1, 2 })
  {
    const int n = 6 << k;
    IndexedTestMesh box = tetBox(n + 1, n + 1, n + 1);
    scale(box, 1.0 / n);
    const StreamMesh mesh = toStream(box);
    ArrayProblem problem = manufactured(mesh, u, f, 0.5 / n);
    const Solved solved = solveMesh(mesh, problem, accurate());
    errors[k] = relativeError(solved.values, sample(mesh, u));
  }
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_GT(errors[0] / errors[1], 3.0);
  EXPECT_GT(errors[1] / errors[2], 3.0);
}

TEST(Problem, EigenfunctionOfTheSphereWithScreening)
{
  // -Laplace z + s z = (2 + s) z on the unit sphere.
  const StreamMesh mesh = toStream(sphere(5));
  for (const double screening : { 0.01, 3.0, 1e4 })
  {
    ArrayProblem problem;
    problem.Screening = screening;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      problem.Source.push_back((2 + screening) * mesh.positions[3 * v + 2]);
    }
    const Solved solved = solveMesh(mesh, problem, accurate());
    EXPECT_LT(relativeError(solved.values, positionsOf(mesh).col(2)), 1e-3);
    EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7) << screening;
    EXPECT_EQ(solved.report.free_components, 0);
  }
}

TEST(Problem, SourcesAndScreeningAgreeWithTheDirectSolution)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(90, 45, 0.3) : tetBox(13, 14, 12, 0.15));
    for (const double screening : { 0.0, 0.2 })
    {
      ArrayProblem problem = heldEnds(mesh, 2, Weights::Clamped);
      problem.Screening = screening;
      problem.Source.resize(2 * mesh.vertices());
      Random random(31);
      for (double& source : problem.Source)
      {
        source = random.uniform(-10, 10);
      }
      const Solved solved = solveMesh(mesh, problem, accurate());
      EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7);
    }
  }
}

TEST(Problem, EdgeTargetsOfThePositionsGiveThemBack)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(90, 45, 0.3) : tetBox(13, 14, 12, 0.15));
    for (const Weights weights : { Weights::Uniform, Weights::Clamped })
    {
      ArrayProblem problem = fixedEnds(mesh);
      problem.EdgeWeights = weights;
      problem.Target = [](const double* p, const double* q, double* d)
      { std::transform(p, p + 3, q, d, std::minus<>()); };
      const Solved solved = solveMesh(mesh, problem, accurate(1e-12));
      EXPECT_LT(relativeError(solved.values, positionsOf(mesh)), 1e-9);
    }
  }
}

TEST(Problem, EdgeTargetsThatAreNoGradientAgreeWithTheDirectSolution)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(90, 45, 0.3) : tetBox(13, 14, 12, 0.15));
    ArrayProblem problem = fixedEnds(mesh);
    // A twist about z by the height in the middle of the edge.
    problem.Target = [](const double* p, const double* q, double* d)
    {
      const double angle = 0.7 * (p[2] + q[2]);
      d[0] = std::cos(angle) * (p[0] - q[0]) - std::sin(angle) * (p[1] - q[1]);
      d[1] = std::sin(angle) * (p[0] - q[0]) + std::cos(angle) * (p[1] - q[1]);
      d[2] = p[2] - q[2];
    };
    const Solved solved = solveMesh(mesh, problem, accurate());
    const Eigen::MatrixXd expected = solveDirectly(mesh, problem);
    EXPECT_LT(relativeError(solved.values, expected), 1e-7);
    EXPECT_GT(relativeError(expected, positionsOf(mesh)), 0.05);
  }
}

/** Their solution may be another altogether; that of a mesh with a few is nearly its own. */
TEST(Problem, ManyCellsThatAreTooFlatAreAWarning)
{
  const auto warned = [](std::int64_t flatColumns)
  {
    IndexedTestMesh indexed = grid(200, 20);
    for (std::size_t i = 0; i < indexed.positions.size(); i += 3)
    {
      double& x = indexed.positions[i];
      x = x <= static_cast<double>(flatColumns) ? 1e-9 * x : x;
    }
    const StreamMesh mesh = toStream(indexed);
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
    const Report report = solveMesh(mesh, problem, accurate()).report;
    const auto isOfThem = [](const std::string& sentence)
    { return sentence.find("so flat that rounding") != std::string::npos; };
    EXPECT_EQ(std::ranges::count_if(report.notes, isOfThem), 1) << flatColumns;
    return std::ranges::count_if(report.warnings, isOfThem);
  };
  EXPECT_EQ(warned(1), 0);
  EXPECT_EQ(warned(100), 1);
}

TEST(Problem, TheMaximumPrincipleHolds)
{
  const StreamMesh mesh = toStream(shuffled(torus(150, 40, 0.9)));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_GT(solved.report.clamped_weights, 0);
  ASSERT_EQ(solved.report.notes.size(), 1U);
  EXPECT_NE(solved.report.notes[0].find("not that of finite elements"), std::string::npos);
  EXPECT_LE(solved.values.maxCoeff(), 1.0 + 1e-8);
  EXPECT_GE(solved.values.minCoeff(), -1.0 - 1e-8);
}

TEST(Problem, TheReportCountsWhatTheDirectSystemCounts)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(shuffled(surface ? torus(90, 45, 0.8) : tetBox(9, 9, 9, 0.2)));
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
    const Report report = solveMesh(mesh, problem).report;
    MemorySource source(mesh);
    const DirectSystem system = assembleDirect(source, problem);
    EXPECT_EQ(report.vertices, mesh.vertices());
    EXPECT_EQ(report.cells, mesh.cells());
    EXPECT_EQ(report.prescribed, system.prescribed);
    EXPECT_EQ(report.clamped_weights, system.clampedWeights);
    EXPECT_EQ(report.levels[0].nodes, system.unknowns());
    EXPECT_EQ(report.levels[0].nonzeros, system.matrix.nonZeros());
    for (std::size_t l = 1; l < report.levels.size(); ++l)
    {
      EXPECT_LT(report.levels[l].nodes, report.levels[l - 1].nodes / 2);
    }
    EXPECT_EQ(report.components, 1);
  }
}

} // namespace smg::testing
