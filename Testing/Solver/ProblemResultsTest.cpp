// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Testing/Solver/WaveProblem.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

constexpr int Columns = WaveColumns;

/** A problem with every type of datum, and two adjacent Dirichlet conditions. */
ElementProblem wholeFamily(const StreamMesh& mesh)
{
  ElementProblem problem(mesh);
  setEverything(problem);
  return problem;
}

/** The results of a problem, and their solution. */
struct Told
{
  Eigen::MatrixXd values;
  Report report;
  std::vector<double> gradient, flux;
};

Told resultsOf(const StreamMesh& mesh, Problem& problem, const SolveOptions& options,
  std::int64_t blockCells = 1000)
{
  MemorySource source(mesh, blockCells);
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  Told told{ valuesOf(*solution), solution->report(), {}, {} };
  source.rewind(blockCells);
  ProblemResults results(source.info(), problem, *solution, { true, true });
  for (MeshBlock block; source.next(block);)
  {
    results.add(block);
    told.gradient.insert(told.gradient.end(), results.gradient().begin(), results.gradient().end());
    told.flux.insert(told.flux.end(), results.flux().begin(), results.flux().end());
  }
  results.finish(told.report);
  return told;
}

std::vector<StreamMesh> meshesOfResults()
{
  return { patch(), block() };
}

/** The gradient of a cell in the results, for a column. */
Eigen::Vector3d vectorOf(const std::vector<double>& numbers, std::int64_t cell, int columns, int k)
{
  return Eigen::Vector3d::Map(&numbers[3 * (cell * columns + k)]);
}

void expectSame(const std::vector<double>& a, const std::vector<double>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    EXPECT_EQ(a[k], b[k]);
  }
}

} // namespace

TEST(ProblemResults, TheGradientOfALinearFunctionIsItsSlopeInTheCell)
{
  const Eigen::Vector3d slope(1.0, -2.0, 0.5);
  for (const StreamMesh& mesh : meshesOfResults())
  {
    ElementProblem problem(mesh);
    problem.Columns = Columns;
    problem.Conductivity = someTensor;
    problem.DirichletConditions.push_back({ [](const Point&) { return true; },
      columnsOf(Columns, [&](const Point& p, int k) { return (1.0 + k) * slope.dot(p); }) });
    const Told told = resultsOf(mesh, problem, {});
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      Eigen::Vector3d expected = slope;
      if (mesh.cellType == CellType::Triangle)
      {
        const Point a = problem.vertex(mesh.corners[3 * c]);
        const Eigen::Vector3d normal = (problem.vertex(mesh.corners[3 * c + 1]) - a)
                                         .cross(problem.vertex(mesh.corners[3 * c + 2]) - a)
                                         .normalized();
        expected -= normal.dot(slope) * normal;
      }
      for (int k = 0; k < Columns; ++k)
      {
        EXPECT_LT((vectorOf(told.gradient, c, Columns, k) - (1.0 + k) * expected).norm(), 1e-12);
        EXPECT_LT((vectorOf(told.flux, c, Columns, k) +
                    (1.0 + k) * someTensor(problem.centroid(c)) * expected)
                    .norm(),
          1e-12);
      }
    }
  }
}

TEST(ProblemResults, AreThoseOfTheAssembledSystem)
{
  for (const StreamMesh& mesh : meshesOfResults())
  {
    ElementProblem problem = wholeFamily(mesh);
    const Told told = resultsOf(mesh, problem, accurate(1e-12));
    const DirectElements direct(problem);
    const Report& report = told.report;
    const Eigen::MatrixXd& u = told.values;
    const Eigen::MatrixXd reaction = direct.matrix * u - direct.rightSide;
    ASSERT_EQ(report.conditions.size(), 4u);
    for (const int d : { 0, 1 })
    {
      EXPECT_EQ(report.conditions[d].name, "dirichlet[" + std::to_string(d) + "]");
      Eigen::RowVectorXd expected = Eigen::RowVectorXd::Zero(Columns);
      for (std::int64_t v = 0; v < mesh.vertices(); ++v)
      {
        expected += problem.dirichletOf(v) == d ? reaction.row(v).eval()
                                                : Eigen::RowVectorXd::Zero(Columns).eval();
      }
      for (int k = 0; k < Columns; ++k)
      {
        EXPECT_NEAR(report.conditions[d].flux[k], expected[k], 1e-6 * expected.norm());
      }
    }
    double sums[4] = {};
    double means[4] = {};
    double fluxes[2] = {};
    for (const DirectElements::Facet& facet : direct.boundary)
    {
      const int first = problem.dirichletOf(facet.corners[0]);
      const bool same = std::ranges::all_of(
        facet.corners, [&](std::int64_t v) { return problem.dirichletOf(v) == first; });
      const bool holds[4] = { same && first == 0, same && first == 1,
        problem.conditionOf(problem.FluxConditions, facet.corners) == 0,
        problem.conditionOf(problem.RobinConditions, facet.corners) == 0 };
      for (const std::int64_t v : facet.corners)
      {
        const double share = facet.area / static_cast<double>(facet.corners.size());
        const Point p = problem.vertex(v);
        for (int c = 0; c < 4; ++c)
        {
          sums[c] += holds[c] ? share : 0.0;
          means[c] += holds[c] ? share * u(v, 1) : 0.0;
        }
        fluxes[0] += holds[2] ? share * wave(p, 1) : 0.0;
        fluxes[1] += holds[3] ? share * (1.0 + p[0]) * (wave(p, 1) - u(v, 1)) : 0.0;
      }
    }
    for (int c = 0; c < 4; ++c)
    {
      EXPECT_GT(sums[c], 0.0);
      EXPECT_NEAR(report.conditions[c].area, sums[c], 1e-12 * sums[c]);
      EXPECT_NEAR(report.conditions[c].mean[1], means[c] / sums[c], 1e-12);
    }
    EXPECT_EQ(report.conditions[2].name, "flux[0]");
    EXPECT_EQ(report.conditions[3].name, "robin[0]");
    EXPECT_NEAR(report.conditions[2].flux[1], fluxes[0], 1e-12 * std::fabs(fluxes[0]));
    EXPECT_NEAR(report.conditions[3].flux[1], fluxes[1], 1e-12 * std::fabs(fluxes[1]));

    for (int k = 0; k < Columns; ++k)
    {
      const Eigen::VectorXd x = u.col(k);
      const double energy =
        0.5 * (x.dot(direct.stiffness * x) + x.dot(direct.screening.asDiagonal() * x));
      EXPECT_NEAR(report.energy[k], energy, 1e-10 * energy);
      EXPECT_NEAR(report.mean[k], direct.mass.dot(x) / direct.mass.sum(), 1e-12);
      EXPECT_NEAR(report.source[k], direct.source.col(k).sum(), 1e-10);
      EXPECT_NEAR(report.screening[k], direct.screening.dot(x), 1e-10);
      EXPECT_EQ(report.minimum[k].value, x.minCoeff());
      EXPECT_EQ(x[report.minimum[k].vertex], x.minCoeff());
      EXPECT_EQ(report.maximum[k].value, x.maxCoeff());
      EXPECT_EQ(x[report.maximum[k].vertex], x.maxCoeff());
    }
  }
}

TEST(ProblemResults, FluxesBalanceToTheTolerance)
{
  for (const StreamMesh& mesh : meshesOfResults())
  {
    for (const Weights weights : { Weights::Cotangent, Weights::Clamped, Weights::Uniform })
    {
      for (const double tolerance : { 1e-4, 1e-8, 1e-12 })
      {
        ElementProblem problem = wholeFamily(mesh);
        problem.EdgeWeights = weights;
        const Told told = resultsOf(mesh, problem, accurate(tolerance));
        EXPECT_TRUE(told.report.converged);
        for (const double balance : told.report.balance)
        {
          EXPECT_LT(std::fabs(balance), 10 * tolerance + 1e-14);
        }
      }
    }
  }
}

/** The residual of a loose solve is not a flow that violates the balance. */
TEST(ProblemResults, BalanceWhereNothingFlows)
{
  for (const StreamMesh& mesh : meshesOfResults())
  {
    for (const double tolerance : { 1e-3, 1e-6, 1e-10 })
    {
      ElementProblem held(mesh), cooled(mesh);
      const auto seven = columnsOf(1, [](const Point&, int) { return 7.0; });
      held.DirichletConditions.push_back({ above(0, 1.0), seven });
      held.DirichletConditions.push_back({ above(0, 2.0), seven });
      cooled.RobinConditions.push_back({ above(0, 1.0), [](const Point&) { return 2.0; }, seven });
      for (ElementProblem* problem : { &held, &cooled })
      {
        const Report report = resultsOf(mesh, *problem, accurate(tolerance)).report;
        EXPECT_EQ(report.balance[0], 0.0) << tolerance;
        for (const std::string& warning : report.warnings)
        {
          EXPECT_FALSE(contains(warning, "flux")) << warning;
        }
      }
    }
  }
}

TEST(ProblemResults, WarnOfFluxesThatMissTheirBalance)
{
  for (const StreamMesh& mesh : meshesOfResults())
  {
    ElementProblem problem(mesh);
    const auto ofX = columnsOf(1, [](const Point& p, int) { return 100.0 * p[0]; });
    problem.DirichletConditions.push_back({ below(0, 0.6), ofX });
    problem.DirichletConditions.push_back({ above(0, 2.0), ofX });
    const Report report = resultsOf(mesh, problem, accurate(0.2)).report;
    ASSERT_TRUE(report.converged);
    ASSERT_EQ(report.warnings.size(), 1U);
    const bool isLost = std::isnan(report.balance[0]);
    EXPECT_TRUE(isLost || std::fabs(report.balance[0]) > 1e-3);
    EXPECT_TRUE(contains(report.warnings[0], isLost ? "is not known" : "known up to"))
      << report.warnings[0];
  }
}

/** The rim of a flat cell, as a clip leaves it, whose vertex nothing determines. */
TEST(ProblemResults, ConditionsWhereNothingIsDeterminedAreFinite)
{
  IndexedTestMesh flat = grid(14, 12, 0.2);
  flat.positions.insert(
    flat.positions.end(), flat.positions.begin() + 3 * 40, flat.positions.begin() + 3 * 41);
  const std::int64_t added = flat.vertices() - 1;
  flat.corners.insert(flat.corners.end(), { 40, 41, added });
  const StreamMesh mesh = toStream(flat);
  const auto everywhere = [](const Point&) { return true; };
  const auto one = columnsOf(1, [](const Point&, int) { return 1.0; });
  for (const double coefficient : { 0.0, 2.0 })
  {
    ElementProblem problem(mesh);
    problem.KeepsUndetermined = false;
    problem.DirichletConditions.push_back({ below(0, 0.6), one });
    problem.FluxConditions.push_back({ everywhere, one });
    problem.RobinConditions.push_back(
      { everywhere, [=](const Point&) { return coefficient; }, one });
    const Told told = resultsOf(mesh, problem, accurate(1e-12));
    // What a Robin condition takes from the rim determines the vertex.
    const bool isDetermined = coefficient > 0.0;
    EXPECT_EQ(told.values.array().isNaN().count(), isDetermined ? 0 : 1);
    for (const Report::Condition& condition : told.report.conditions)
    {
      EXPECT_TRUE(std::isfinite(condition.mean[0])) << condition.name;
      EXPECT_TRUE(std::isfinite(condition.flux[0])) << condition.name;
    }
    EXPECT_GT(told.report.conditions[1].flux[0], 1.0);
    EXPECT_NEAR(told.report.balance[0], 0.0, 1e-9);
    EXPECT_TRUE(std::isfinite(told.report.mean[0]));
    EXPECT_EQ(told.report.coincident_cells, 1);
    EXPECT_EQ(told.report.held, isDetermined ? 0 : 1);
    ASSERT_EQ(told.report.warnings.size(), isDetermined ? 1U : 2U);
    EXPECT_EQ(told.report.warnings.front().find("1 cell without area or volume joins"), 0U);
  }
}

TEST(ProblemResults, AConditionThatOthersHideIsNoted)
{
  const StreamMesh mesh = meshesOfResults().front();
  ElementProblem problem(mesh);
  const auto one = columnsOf(1, [](const Point&, int) { return 1.0; });
  // Here the first one counts.
  problem.DirichletConditions.push_back({ above(0, 1.0), one });
  problem.DirichletConditions.push_back({ above(0, 2.0), one });
  const Report report = resultsOf(mesh, problem, accurate()).report;
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_TRUE(report.warnings[0].ends_with("has no effect: others hold wherever it does"));
  EXPECT_EQ(std::ranges::count(report.notes, report.warnings[0]), 1);
}

TEST(ProblemResults, WhatIsTakenFromTheSourcesIsPartOfTheBalance)
{
  for (const StreamMesh& mesh : meshesOfResults())
  {
    ElementProblem problem(mesh);
    problem.CellSource = columnsOf(1, [](const Point& p, int) { return p[0]; });
    problem.FluxConditions.push_back(
      { above(0, 4.0), columnsOf(1, [](const Point&, int) { return 2.0; }) });
    const Told told = resultsOf(mesh, problem, accurate());
    EXPECT_GT(told.report.removed_source[0], 1.0);
    EXPECT_LT(std::fabs(told.report.balance[0]), 1e-12);
    EXPECT_NEAR(told.report.source[0], -told.report.conditions[0].flux[0],
      1e-9 * told.report.removed_source[0]);
  }
}

TEST(ProblemResults, DoNotDependOnBlocks)
{
  for (const StreamMesh& mesh : meshesOfResults())
  {
    ElementProblem problem = wholeFamily(mesh);
    const Told expected = resultsOf(mesh, problem, accurate(1e-3));
    for (const std::int64_t cells : { 1, 17, 256 })
    {
      const Told told = resultsOf(mesh, problem, accurate(1e-3), cells);
      expectSame(told.gradient, expected.gradient);
      expectSame(told.flux, expected.flux);
      expectSame(told.report.energy, expected.report.energy);
      expectSame(told.report.mean, expected.report.mean);
      expectSame(told.report.balance, expected.report.balance);
      for (std::size_t c = 0; c < expected.report.conditions.size(); ++c)
      {
        EXPECT_EQ(told.report.conditions[c].area, expected.report.conditions[c].area);
        expectSame(told.report.conditions[c].mean, expected.report.conditions[c].mean);
        expectSame(told.report.conditions[c].flux, expected.report.conditions[c].flux);
      }
    }
  }
}

TEST(ProblemResults, AConditionWithoutFacetsHasTheMeanOfItsVertices)
{
  const StreamMesh mesh = toStream(shuffled(torus(30, 20)));
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back(
    { above(0, 2.9), columnsOf(1, [](const Point&, int) { return 4.0; }) });
  problem.FluxConditions.push_back(
    { above(0, 2.0), columnsOf(1, [](const Point&, int) { return 1.0; }) });
  const Report report = resultsOf(mesh, problem, accurate()).report;
  EXPECT_EQ(report.conditions[0].area, 0.0);
  EXPECT_DOUBLE_EQ(report.conditions[0].mean[0], 4.0);
  EXPECT_EQ(report.conditions[1].area, 0.0);
  EXPECT_TRUE(std::isnan(report.conditions[1].mean[0]));
  EXPECT_EQ(report.notes.back().find("flux[0] has no effect"), 0u);
  EXPECT_NE(report.json().find("\"mean\": [\n        null\n"), std::string::npos);
}

TEST(ProblemResults, SayByHowMuchFlatCellsMayHaveChangedTheSolution)
{
  // A vertex almost on the opposite edge.
  StreamMesh mesh = toStream(grid(20, 20));
  const std::int64_t* cell = &mesh.corners[3 * (mesh.cells() / 2)];
  for (int d = 0; d < 3; ++d)
  {
    mesh.positions[3 * cell[0] + d] =
      0.5 * (mesh.positions[3 * cell[1] + d] + mesh.positions[3 * cell[2] + d]);
  }
  mesh.positions[3 * cell[0] + 1] += 1e-7;
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back(
    { below(0, 0.6), columnsOf(1, [](const Point&, int) { return 0.0; }) });
  problem.VertexSource = columnsOf(1, wave);
  const Told told = resultsOf(mesh, problem, accurate(1e-9));
  ASSERT_TRUE(hasNote(told.report, "in the energy norm"));
  // The bound holds: the energy of the difference from the direct solution is below it.
  const DirectElements direct(problem);
  const Eigen::VectorXd difference = told.values - direct.solve();
  const double share =
    std::sqrt(0.5 * difference.dot(direct.stiffness * difference) / told.report.energy[0]);
  const std::string note = *std::ranges::find_if(told.report.notes,
    [](const std::string& text) { return text.find("in the energy norm") != std::string::npos; });
  const double percent = std::stod(note.substr(note.find("at most ") + 8));
  EXPECT_LT(100 * share, percent);
  EXPECT_GT(percent, 0.0);
}

TEST(ProblemResults, OfAnotherSolutionAreAnError)
{
  const StreamMesh mesh = patch();
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back({ below(0, 0.6), {} });
  MemorySource source(mesh);
  const std::unique_ptr<Solution> solution = solve(source, problem);
  problem.Columns = 2;
  EXPECT_NE(messageOf([&] { ProblemResults(source.info(), problem, *solution); }).find("columns"),
    std::string::npos);
}

} // namespace smg::testing
