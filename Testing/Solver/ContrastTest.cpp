// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Estimate/Costs.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Testing/Solver/ContrastTesting.h"
#include "Testing/Support/QuadrupleElements.h"
#include "smg/LinearSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

// Conductivities that differ by up to 1e12: energy, the flux of every condition and the mean flux
// of every part, against linear finite elements that are assembled and solved in quadruple
// precision. A double has the solution, but not what flows in the good conductor.

namespace smg::testing
{
namespace
{

/** The largest relative errors of the results of a report. */
struct Errors
{
  double energy = 0.0, flux = 0.0, mean = 0.0;
};

Errors errorsOf(const Report& report, const ExactResults& exact)
{
  Errors errors{ std::fabs(report.energy[0] / exact.energy - 1.0) };
  double largest = 0.0;
  for (const auto& [name, flux] : exact.flux)
  {
    largest = std::max(largest, std::fabs(flux));
  }
  for (const Report::Condition& condition : report.conditions)
  {
    // A flux that is a millionth of the largest one has that many digits less.
    const double flux = exact.flux.at(condition.name);
    errors.flux = std::max(
      errors.flux, std::fabs(condition.flux[0] - flux) / std::max(std::fabs(flux), 1e-3 * largest));
  }
  for (const Report::Part& part : report.parts)
  {
    const auto& means = exact.parts.at(part.name);
    for (const auto& [mean, expected] :
      { std::pair(&part.gradient, means[0]), { &part.flux, means[1] } })
    {
      errors.mean =
        std::max(errors.mean, (Point::Map(mean->data()) - expected).norm() / expected.norm());
    }
  }
  return errors;
}

TEST(Contrast, EnergyFluxesAndMeansAreThoseOfQuadruplePrecision)
{
  forShapes({ 1.0, 1e3, 1e6, 1e9, 1e12 },
    [](ElementProblem& problem, const std::string& name)
    {
      const Report report = resultsOf(problem);
      const ExactResults exact = solveInQuadruple(problem);
      ASSERT_EQ(report.parts.size(), exact.parts.size());
      const Errors errors = errorsOf(report, exact);
      constexpr double Known = 1e-6;
      EXPECT_LE(errors.energy, Known);
      EXPECT_LE(errors.flux, Known);
      EXPECT_LE(errors.mean, Known);
      EXPECT_LE(std::fabs(report.balance[0]), Known);
      EXPECT_TRUE(report.converged);
      EXPECT_EQ(report.warnings, std::vector<std::string>());
      // For Testing/Verification/contrast.py.
      ::testing::Test::RecordProperty(name,
        scientific(errors.energy) + ' ' + scientific(errors.flux) + ' ' + scientific(errors.mean) +
          ' ' + scientific(std::fabs(report.balance[0])) + ' ' + std::to_string(report.cycles));
    });
}

TEST(Contrast, CorrectionsDependOnNoBlocksThreadsOrScratch)
{
  int corrections = 0;
  forShapes({ 1e10 },
    [&corrections](ElementProblem& problem, const std::string&)
    {
      const Report report = resultsOf(problem);
      SolveOptions inCore, streamed;
      inCore.inCore = true;
      inCore.threads = 1;
      streamed.coreNodes = 0;
      streamed.blockNodes = 64;
      streamed.threads = 3;
      corrections += report.passes - report.cycles - 1;
      for (const auto& [options, block] : { std::pair(inCore, 37), { streamed, 100 } })
      {
        const Report other = resultsOf(problem, options, block);
        EXPECT_EQ(other.energy, report.energy);
        for (std::size_t c = 0; c < report.conditions.size(); ++c)
        {
          EXPECT_EQ(other.conditions[c].flux, report.conditions[c].flux);
        }
      }
    });
  EXPECT_GT(corrections, 0);
}

/** Fluxes are right, unless a warning says how far they are known, or that they are not. */
TEST(Contrast, EveryFluxIsRightOrSaidToBeUnknown)
{
  int known = 0, lost = 0;
  forShapes({ 1e4, 1e8, 1e12, 1e13 },
    [&](ElementProblem& problem, const std::string&)
    {
      const ExactResults exact = solveInQuadruple(problem);
      double all = 0.0;
      for (const auto& [name, flux] : exact.flux)
      {
        all += std::fabs(flux);
      }
      SolveOptions loose, few, automatic, noRoom;
      loose.tolerance = 1e-3;
      few.maxCycles = 4;
      automatic.tolerance = SolveOptions::AutomaticTolerance;
      noRoom.inCore = true;
      noRoom.maxCycles = 12;
      for (const SolveOptions& options : { SolveOptions(), loose, few, automatic, noRoom })
      {
        const Report report = resultsOf(problem, options);
        const bool says = !report.warnings.empty() || !report.converged;
        for (const Report::Condition& condition : report.conditions)
        {
          const double flux = exact.flux.at(condition.name), found = condition.flux[0];
          const double error = std::fabs(found - flux);
          // Of a flux much smaller than others, it is these that count.
          const double size = std::max(std::fabs(flux), 1e-3 * all);
          EXPECT_TRUE(std::isnan(found) ? says : error <= (says ? 0.2 : 1e-3) * all) << found;
          known += error <= 1e-6 * size ? 1 : 0;
          lost += std::isnan(found) ? 1 : 0;
        }
      }
    });
  EXPECT_GT(known, 200);
  EXPECT_GT(lost, 20);
}

TEST(Contrast, WhereNothingFlowsNothingIsSaid)
{
  forShapes({ 1.0, 1e4, 1e9 },
    [](ElementProblem& problem, const std::string&)
    {
      const std::vector<ElementProblem::Dirichlet> ends = problem.DirichletConditions;
      const auto hold = [&](const Eigen::VectorXd& value)
      {
        problem.Columns = static_cast<int>(value.size());
        for (std::size_t c = 0; c < ends.size(); ++c)
        {
          problem.DirichletConditions[c].value = [value](const Point&) { return value; };
        }
        for (ElementProblem::Robin& robin : problem.RobinConditions)
        {
          robin.ambient = [value](const Point&) { return value; };
        }
      };
      for (const double value : { 0.0, 1.0, 293.0, 1e-9 })
      {
        hold(Eigen::Vector2d(value, 0.0));
        const Report report = resultsOf(problem);
        EXPECT_TRUE(report.converged);
        EXPECT_EQ(report.warnings, std::vector<std::string>());
        EXPECT_EQ(report.balance, std::vector<double>(2, 0.0));
        EXPECT_LE(report.cycles, 25);
      }
    });
}

/** A column in which nothing flows changes nothing of another one. */
TEST(Contrast, ColumnsAreJudgedApart)
{
  forShapes({ 1e9 },
    [](ElementProblem& problem, const std::string&)
    {
      const Report one = resultsOf(problem);
      problem.Columns = 2;
      for (ElementProblem::Dirichlet& end : problem.DirichletConditions)
      {
        end.value = [value = end.value](const Point& x)
        { return Eigen::Vector2d(value(x)[0], 0.0); };
      }
      for (ElementProblem::Robin& robin : problem.RobinConditions)
      {
        robin.ambient = [ambient = robin.ambient](const Point& x)
        { return Eigen::Vector2d(ambient(x)[0], 0.0); };
      }
      const Report two = resultsOf(problem);
      EXPECT_EQ(two.warnings, std::vector<std::string>());
      EXPECT_LE(two.cycles, one.cycles + 3);
      for (std::size_t c = 0; c < one.conditions.size(); ++c)
      {
        EXPECT_NEAR(two.conditions[c].flux[0] / one.conditions[c].flux[0], 1.0, 1e-6);
      }
    });
}

TEST(Contrast, AStartFromTheSolutionHasItsFluxes)
{
  forShapes({ 1e9 },
    [](ElementProblem& problem, const std::string&)
    {
      const StreamMesh& mesh = problem.mesh();
      MemorySource source(mesh);
      const std::unique_ptr<Solution> solution = solve(source, problem);
      std::vector<double> values(static_cast<std::size_t>(mesh.vertices()));
      solution->read(0, mesh.vertices(), values);
      problem.Initial = [&](const Point& x)
      {
        std::int64_t v = 0;
        while (problem.vertex(v) != x)
        {
          ++v;
        }
        return Eigen::VectorXd::Constant(1, values[static_cast<std::size_t>(v)]);
      };
      const Report report = resultsOf(problem);
      const ExactResults exact = solveInQuadruple(problem);
      EXPECT_EQ(report.warnings, std::vector<std::string>());
      EXPECT_LE(errorsOf(report, exact).flux, 1e-6);
    });
}

TEST(Contrast, RobinCoefficientsOfAnySize)
{
  const StreamMesh mesh = toStream(tetBox(9, 5, 5, 0.15));
  for (const double coefficient : { 1e-6, 1.0, 1e6, 1e9, 1e11, 1e13 })
  {
    SCOPED_TRACE(coefficient);
    ElementProblem problem(mesh);
    problem.Parts = 1;
    problem.Part = [](const Point&) { return 0; };
    problem.Conductivity = [](const Point&) -> Eigen::Matrix3d
    { return Eigen::Matrix3d::Identity(); };
    hold(problem, below(0, 0.5), 1.0);
    problem.RobinConditions.push_back(
      { above(0, 7.5), [coefficient](const Point&) { return coefficient; },
        [](const Point&) { return Eigen::VectorXd::Constant(1, 20.0); } });
    const Report report = resultsOf(problem);
    const ExactResults exact = solveInQuadruple(problem);
    // From 1e12 on the difference to the ambient value has few digits.
    EXPECT_LE(errorsOf(report, exact).flux, coefficient <= 1e11 ? 1e-4 : 1e-2);
    if (coefficient <= 1e11)
    {
      EXPECT_EQ(report.warnings, std::vector<std::string>());
    }
  }
}

TEST(Contrast, CorrectionsKeepToTheMostVCycles)
{
  forShapes({ 1e12 },
    [](ElementProblem& problem, const std::string&)
    {
      const ExactResults exact = solveInQuadruple(problem);
      const int needed = resultsOf(problem).cycles;
      for (int most = 1; most < needed; most += 3)
      {
        SolveOptions options;
        options.maxCycles = most;
        const Report report = resultsOf(problem, options);
        EXPECT_LE(report.cycles, most);
        EXPECT_TRUE(
          !report.converged || !report.warnings.empty() || errorsOf(report, exact).flux <= 1e-6);
      }
    });
}

/** A strip of a good conductor carries most of what flows; beside it are flat cells of a bad one,
 * whose own condition is to be known as well as without the strip. */
TEST(Contrast, BadConductorsAreSolvedBesideGoodOnesThatCarryMore)
{
  constexpr int n = 60;
  constexpr double Flatness = 30.0;
  IndexedTestMesh sheet = grid(n, n, 0.25);
  const double strip = 0.1 * n * std::sqrt(0.75), height = (n - 1) * std::sqrt(0.75);
  for (std::size_t k = 1; k < sheet.positions.size(); k += 3)
  {
    double& y = sheet.positions[k];
    y = y <= strip ? y : strip + (y - strip) * Flatness;
  }
  const double top = strip + (height - strip) * Flatness;
  const StreamMesh mesh = toStream(sheet);
  for (const double contrast : { 1.0, 1e3, 1e6, 1e9 })
  {
    SCOPED_TRACE(contrast);
    ElementProblem problem(mesh);
    problem.Parts = 2;
    problem.Part = [=](const Point& x) { return x[1] < strip ? 1 : 0; };
    problem.Conductivity = [&](const Point& x) -> Eigen::Matrix3d
    { return (problem.Part(x) == 0 ? 1.0 : contrast) * Eigen::Matrix3d::Identity(); };
    hold(
      problem, [=](const Point& x) { return x[1] < strip && x[0] < 0.1; }, 0.0);
    hold(
      problem, [=](const Point& x) { return x[1] < strip && x[0] > n - 1.1; }, 1.0);
    hold(problem, above(1, top - 1.0), 0.0);
    const Report report = resultsOf(problem);
    const ExactResults exact = solveInQuadruple(problem);
    for (const Report::Condition& condition : report.conditions)
    {
      EXPECT_NEAR(condition.flux[0] / exact.flux.at(condition.name), 1.0, 1e-5) << condition.name;
    }
  }
}

/** Progress goes on while a correction is computed, and estimates count it. */
TEST(Contrast, FurtherSolvesAreJudgedByWhatFlowsAlsoAtTheirStart)
{
  const StreamMesh mesh = toStream(grid(60, 50));
  const auto isRight = [](const Point& x) { return x[0] > 58.0; };
  ElementProblem problem(mesh);
  problem.Parts = 2;
  problem.Part = [](const Point& x) { return x[0] < 30.0 ? 0 : 1; };
  problem.Conductivity = [&](const Point& x) -> Eigen::Matrix3d
  { return (problem.Part(x) == 0 ? 1.0 : 1e6) * Eigen::Matrix3d::Identity(); };
  hold(problem, below(0, 0.6), 0.0);
  hold(problem, isRight, 1.0);
  std::vector<double> b(static_cast<std::size_t>(mesh.vertices()));
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    b[static_cast<std::size_t>(v)] = isRight(problem.vertex(v)) ? 1.0 : 0.0;
  }
  MemorySource source(mesh);
  LinearSolver solver(source, problem);
  std::vector<double> x(b.size());
  EXPECT_GT(solver.solve(b, x).cycles, 1);
  // What flows is measured by a V-cycle, not by the sweeps before it: see PoissonSolver.
  EXPECT_EQ(solver.solve(b, x).cycles, 1);
}

TEST(Contrast, ProgressAndEstimatesCountCorrections)
{
  int corrections = 0;
  for (const double contrast : { 1e2, 1e6, 1e7, 1e10 })
  {
    forShapes({ contrast },
      [&](ElementProblem& problem, const std::string&)
      {
        std::vector<double> shares;
        SolveOptions options;
        options.progress = [&shares](double share)
        {
          shares.push_back(share);
          return true;
        };
        const Report report = resultsOf(problem, options);
        EXPECT_TRUE(std::ranges::is_sorted(shares));
        EXPECT_EQ(shares.back(), 1.0);
        EXPECT_LE(std::ranges::count(shares, 1.0), 2);
        if (report.passes == report.cycles + 1)
        {
          return;
        }
        ++corrections;
        const StreamInfo info = MemorySource(problem.mesh()).info();
        const auto passes = [&info](double of)
        { return solveCosts(info, 1, Weights::Cotangent, SolveOptions(), of).passes; };
        EXPECT_TRUE(contrast < 1e7 || passes(contrast) > passes(1.0));
        EXPECT_LE(passes(contrast), 2 * report.passes);
        EXPECT_GE(2 * passes(contrast), report.passes);
      });
  }
  EXPECT_GT(corrections, 20);
}

/** What a correction has mended is not said, and the residual that is said is that of the report.
 */
TEST(Contrast, NotesStateTheResidualOfTheReport)
{
  forShapes({ 1.0, 1e5, 1e7, 1e9, 1e11 },
    [](ElementProblem& problem, const std::string&)
    {
      const Report report = resultsOf(problem);
      for (const std::string& note : report.notes)
      {
        const std::string before = "the relative residual is ";
        const std::size_t place = note.find(before);
        if (place != std::string::npos && !note.starts_with("the correction of rounding"))
        {
          EXPECT_EQ(note.substr(place + before.size()), scientific(report.residuals.back()));
        }
      }
    });
}

TEST(Contrast, WhatRoundingTakesIsSaid)
{
  const StreamMesh mesh = toStream(tetBox(9, 5, 5, 0.15));
  ElementProblem problem(mesh);
  problem.Part = [](const Point& x) { return x[0] < 4.0 ? 0 : 1; };
  problem.Parts = 2;
  hold(problem, below(0, 0.5), 0.0);
  hold(problem, above(0, 7.5), 1.0);
  problem.Conductivity = [&](const Point& x) -> Eigen::Matrix3d
  { return (problem.Part(x) == 0 ? 1.0 : 1e14) * Eigen::Matrix3d::Identity(); };
  const Report report = resultsOfOneReading(problem);
  EXPECT_TRUE(std::isnan(report.conditions[1].flux[0]));
  EXPECT_TRUE(std::isnan(report.balance[0]));
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_TRUE(contains(report.warnings[0], "the flux of dirichlet[0], dirichlet[1] is not known"))
    << report.warnings[0];
}

} // namespace
} // namespace smg::testing
