// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/Team.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/WaveProblem.h"

#include <gtest/gtest.h>

// The results of a solution in parts are those of the same solution in one stream.

namespace smg::testing
{
namespace
{

/** Dirichlet conditions alone, without data on facets or in cells. */
void setEnds(ElementProblem& problem)
{
  problem.Columns = WaveColumns;
  problem.VertexSource = columnsOf(WaveColumns, wave);
  problem.DirichletConditions.push_back({ below(0, 0.9), columnsOf(WaveColumns, wave) });
  problem.DirichletConditions.push_back({ above(0, 4.0), columnsOf(WaveColumns, wave) });
}

/** A report and the cell results of all processes, in stream order. */
struct Results
{
  Report report;
  std::vector<double> gradient, flux;
};

struct Evaluated
{
  Results ofParts;
  Eigen::MatrixXd values;
  Report ofSolve;
};

Evaluated evaluateParts(
  const StreamMesh& mesh, const std::vector<std::int64_t>& cuts, const Setting& set)
{
  const MeshPart part = partOf(mesh, cuts);
  const StreamMesh own = meshOf(part);
  ElementProblem problem(own);
  set(problem);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  DistributedOptions options;
  options.tolerance = 1e-8;
  DistributedSolution solution = solver.solve(problem, options);
  Evaluated evaluated{ {}, wholeSolution(solver, solution), solution.report };
  solver.evaluate(problem, solution, { true, true });
  Team team(MPI_COMM_WORLD);
  evaluated.ofParts = { solution.report, team.gather(solution.gradient),
    team.gather(solution.flux) };
  return evaluated;
}

/** On one process. */
Results evaluateStream(
  const StreamMesh& mesh, const Setting& set, const Eigen::MatrixXd& values, const Report& ofSolve)
{
  ElementProblem problem(mesh);
  set(problem);
  const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> rows = values;
  InMemorySolution solution({ rows.data(), static_cast<std::size_t>(rows.size()) }, WaveColumns);
  MemorySource source(mesh);
  ProblemResults results(source.info(), problem, solution, { true, true });
  Results told{ ofSolve, {}, {} };
  for (MeshBlock block; source.next(block);)
  {
    results.add(block);
    told.gradient.insert(told.gradient.end(), results.gradient().begin(), results.gradient().end());
    told.flux.insert(told.flux.end(), results.flux().begin(), results.flux().end());
  }
  results.finish(told.report);
  return told;
}

void expectNear(
  const std::vector<double>& a, const std::vector<double>& b, double scale, const char* name)
{
  ASSERT_EQ(a.size(), b.size()) << name;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    // Means of conditions that hold nowhere are no numbers.
    EXPECT_TRUE((std::isnan(a[k]) && std::isnan(b[k])) || std::fabs(a[k] - b[k]) <= 1e-12 * scale)
      << name << ": " << a[k] << ", " << b[k];
  }
}

void expectSameExtremes(
  const std::vector<Report::Extreme>& a, const std::vector<Report::Extreme>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    EXPECT_EQ(a[k].value, b[k].value);
    EXPECT_EQ(a[k].vertex, b[k].vertex);
  }
}

/** All terms of a report have the size 1 to 1000. */
void expectEqual(const Results& a, const Results& b)
{
  constexpr double Scale = 1000.0;
  expectNear(a.gradient, b.gradient, Scale, "gradient");
  expectNear(a.flux, b.flux, Scale, "flux");
  expectNear(a.report.energy, b.report.energy, Scale, "energy");
  expectNear(a.report.mean, b.report.mean, Scale, "mean");
  expectNear(a.report.source, b.report.source, Scale, "source");
  expectNear(a.report.screening, b.report.screening, Scale, "screening");
  expectNear(a.report.balance, b.report.balance, Scale, "balance");
  expectSameExtremes(a.report.minimum, b.report.minimum);
  expectSameExtremes(a.report.maximum, b.report.maximum);
  EXPECT_EQ(a.report.notes, b.report.notes);
  ASSERT_EQ(a.report.conditions.size(), b.report.conditions.size());
  for (std::size_t c = 0; c < a.report.conditions.size(); ++c)
  {
    const Report::Condition& one = a.report.conditions[c];
    const Report::Condition& other = b.report.conditions[c];
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.vertices, other.vertices) << one.name;
    EXPECT_NEAR(one.area, other.area, 1e-12 * Scale) << one.name;
    expectNear(one.mean, other.mean, Scale, one.name.c_str());
    expectNear(one.flux, other.flux, Scale, one.name.c_str());
  }
}

void check(const StreamMesh& mesh, const std::vector<std::int64_t>& cuts, const Setting& set)
{
  const Evaluated parts = evaluateParts(mesh, cuts, set);
  if (rankOfTest() == 0)
  {
    expectEqual(parts.ofParts, evaluateStream(mesh, set, parts.values, parts.ofSolve));
  }
}

} // namespace

TEST(DistributedResults, AreThoseOfTheStream)
{
  for (const StreamMesh& mesh : { patch(24, 21), block(), toStream(shuffled(torus(30, 16, 0.2))) })
  {
    check(mesh, evenCuts(mesh.cells(), sizeOfTest()), setEverything);
    check(mesh, evenCuts(mesh.cells(), sizeOfTest()), setEnds);
  }
}

TEST(DistributedResults, AreThoseOfTheStreamWithOtherWeights)
{
  for (const StreamMesh& mesh : { patch(), block() })
  {
    for (const Weights weights : { Weights::Clamped, Weights::Uniform })
    {
      const auto set = [weights](ElementProblem& problem)
      {
        setEverything(problem);
        problem.EdgeWeights = weights;
      };
      check(mesh, evenCuts(mesh.cells(), sizeOfTest()), set);
    }
  }
}

TEST(DistributedResults, ProcessesMayLackCells)
{
  const StreamMesh solid = block();
  check(solid, cutsWithGaps(solid.cells(), sizeOfTest(), 0), setEverything);
  check(solid, cutsWithGaps(solid.cells(), sizeOfTest(), 1), setEverything);
}

TEST(DistributedResults, OfEqualExtremesTheFirstVertexIsNamed)
{
  const auto flat = [](ElementProblem& problem)
  {
    problem.Columns = WaveColumns;
    problem.DirichletConditions.push_back({ [](const Point&) { return true; },
      columnsOf(WaveColumns, [](const Point& p, int) { return p[0] < 6 ? 1.0 : 2.0; }) });
  };
  const StreamMesh mesh = patch(24, 21);
  check(mesh, evenCuts(mesh.cells(), sizeOfTest()), flat);
}

TEST(DistributedResults, AnEdgeOfManyCellsCountsOnce)
{
  // A fan of triangles around one edge, each on another process: no boundary of the mesh.
  IndexedTestMesh mesh;
  mesh.positions = { 0, 0, 0, 0, 0, 1 };
  for (int k = 0; k < 9; ++k)
  {
    mesh.positions.insert(mesh.positions.end(), { std::cos(0.7 * k), std::sin(0.7 * k), 0.4 });
    mesh.corners.insert(mesh.corners.end(), { 0, 1, 2 + k });
  }
  const auto set = [](ElementProblem& problem)
  {
    problem.Columns = WaveColumns;
    problem.DirichletConditions.push_back({ above(0, 0.9), columnsOf(WaveColumns, wave) });
    problem.DirichletConditions.push_back(
      { [](const Point& p) { return p[0] == 0 && p[1] == 0; }, columnsOf(WaveColumns, wave) });
    problem.FluxConditions.push_back(
      { [](const Point&) { return true; }, columnsOf(WaveColumns, wave) });
  };
  const StreamMesh stream = toStream(mesh);
  check(stream, evenCuts(stream.cells(), sizeOfTest()), set);
}

} // namespace smg::testing
