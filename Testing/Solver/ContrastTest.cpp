// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Support/QuadrupleElements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

// Conductivities that differ by up to 1e12: energy, the flux of every condition and the mean flux
// of every part, against linear finite elements that are assembled and solved in quadruple
// precision. A double has the solution, but not what flows in the good conductor.

namespace smg::testing
{
namespace
{

struct Shape
{
  std::string name;
  /** Sets the part of each point, 0 or 1, and the conditions, for a mesh of this size. */
  std::function<void(ElementProblem&, const Point& size)> set;
};

void hold(ElementProblem& problem, ElementProblem::Where where, double value)
{
  problem.DirichletConditions.push_back(
    { std::move(where), [value](const Point&) { return Eigen::VectorXd::Constant(1, value); } });
}

/** The part is 0 in the lower half, along x, and 1 in the upper one. */
void halve(ElementProblem& problem, const Point& size)
{
  problem.Part = [size](const Point& x) { return x[0] < 0.5 * size[0] ? 0 : 1; };
}

/** What flows differs little from rounding, which must not push the good conductor as a whole up or
 * down. */
std::vector<Shape> looselyHeldShapes()
{
  return {
    { "good conductor held by a bad one",
      [](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        hold(p, below(0, 0.5), 20.0);
        p.RobinConditions.push_back({ above(0, size[0] - 0.5), [](const Point&) { return 0.1; },
          [](const Point&) { return Eigen::VectorXd::Constant(1, 23.0); } });
      } },
    { "good conductor in a bad one",
      [](ElementProblem& p, const Point& size)
      {
        p.Part = [size](const Point& x)
        { return (x - 0.5 * size).norm() < 0.25 * size.norm() ? 1 : 0; };
        for (const bool isFirst : { true, false })
        {
          p.RobinConditions.push_back({ isFirst ? below(0, 0.5) : above(0, size[0] - 0.5),
            [](const Point&) { return 0.1; },
            [isFirst](const Point&) { return Eigen::VectorXd::Constant(1, isFirst ? 0 : 100); } });
        }
      } },
  };
}

std::vector<Shape> shapes()
{
  const auto ends = [](ElementProblem& p, const Point& size)
  {
    hold(p, below(0, 0.5), 0.0);
    hold(p, above(0, size[0] - 0.5), 1.0);
  };
  return {
    { "layers",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        ends(p, size);
      } },
    { "electrode in the good conductor",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        hold(p, below(0, 0.5), 0.0);
        hold(
          p, [size](const Point& x) { return (x - 0.75 * size).norm() < 0.2 * size.norm(); }, 1.0);
      } },
    { "two electrodes, a circuit in the good conductor",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        ends(p, size);
        hold(
          p,
          [size](const Point& x)
          { return x[0] > 0.6 * size[0] && x[0] < 0.9 * size[0] && x[1] < 0.5; },
          1.0);
      } },
    { "inclusions at random",
      [=](ElementProblem& p, const Point& size)
      {
        p.Part = [](const Point& x)
        { return std::sin(2.3 * x[0] + 1.0) * std::cos(1.9 * x[1]) + std::sin(1.7 * x[2]) > 0.2; };
        ends(p, size);
      } },
    { "voids at random",
      [=](ElementProblem& p, const Point& size)
      {
        p.Part = [](const Point& x)
        { return std::sin(2.3 * x[0] + 1.0) * std::cos(1.9 * x[1]) + std::sin(1.7 * x[2]) < 0.5; };
        ends(p, size);
      } },
    { "a film",
      [=](ElementProblem& p, const Point& size)
      {
        // A cell thick: each of its vertices is one of the good conductor, too.
        const double middle = std::floor(0.5 * size[0]);
        p.Part = [middle](const Point& x) { return x[0] > middle && x[0] < middle + 1.0 ? 0 : 1; };
        ends(p, size);
      } },
    { "cooled good conductor",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        hold(p, below(0, 0.5), 1.0);
        p.RobinConditions.push_back({ above(0, 0.7 * size[0]), [](const Point&) { return 3.0; },
          [](const Point&) { return Eigen::VectorXd::Constant(1, 20.0); } });
      } },
  };
}

/** The results of a solve with the options of a user who gave none, and others. */
Report resultsOf(
  ElementProblem& problem, const SolveOptions& others = {}, std::int64_t block = 1000)
{
  const StreamMesh& mesh = problem.mesh();
  SolveOptions options = others;
  options.again = [&mesh, block] { return std::make_unique<MemorySource>(mesh, block); };
  MemorySource source(mesh, block);
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  Report report = solution->report();
  source.rewind(block);
  ProblemResults results(source.info(), problem, *solution);
  for (MeshBlock cells; source.next(cells);)
  {
    results.add(cells);
  }
  results.finish(report);
  return report;
}

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

/** Calls test(problem, name) for each shape, on a surface and a solid, with these contrasts. */
void forShapes(const std::vector<double>& contrasts, auto test)
{
  for (const bool solid : { false, true })
  {
    const StreamMesh mesh = toStream(solid ? tetBox(9, 5, 5, 0.15) : grid(17, 13, 0.1));
    const Point size = solid ? Point(8, 4, 4) : Point(16, 12 * std::sqrt(0.75), 0);
    std::vector<Shape> all = shapes();
    std::ranges::move(looselyHeldShapes(), std::back_inserter(all));
    for (const Shape& shape : all)
    {
      for (const double contrast : contrasts)
      {
        const std::string name =
          shape.name + (solid ? ", solid, " : ", surface, ") + scientific(contrast);
        SCOPED_TRACE(name);
        ElementProblem problem(mesh);
        shape.set(problem, size);
        problem.Parts = 2;
        problem.Conductivity = [&](const Point& x) -> Eigen::Matrix3d
        { return (problem.Part(x) == 0 ? 1.0 : contrast) * Eigen::Matrix3d::Identity(); };
        test(problem, name);
      }
    }
  }
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

/** What flows does not depend on a constant that is added to all values, or it is said by how much.
 */
TEST(Contrast, ValuesThatDifferLittleAreNotOne)
{
  forShapes({ 1.0 },
    [](ElementProblem& problem, const std::string&)
    {
      const Report exact = resultsOf(problem);
      const auto add = [](double constant, std::function<Eigen::VectorXd(const Point&)>& value)
      {
        value = [constant, before = value](const Point& x)
        { return Eigen::VectorXd(before(x).array() + constant); };
      };
      double added = 0.0;
      for (const double constant : { 1e6, 1e9, 1e12 })
      {
        for (ElementProblem::Dirichlet& end : problem.DirichletConditions)
        {
          add(constant - added, end.value);
        }
        for (ElementProblem::Robin& robin : problem.RobinConditions)
        {
          add(constant - added, robin.ambient);
        }
        added = constant;
        // The report does not have the values that Robin conditions compare with.
        if (constant > 1e9 && problem.DirichletConditions.size() < 2)
        {
          continue;
        }
        const Report report = resultsOf(problem);
        double all = 0.0, off = 0.0;
        for (std::size_t c = 0; c < exact.conditions.size(); ++c)
        {
          const double flux = exact.conditions[c].flux[0];
          all += std::fabs(flux);
          off = std::max(off, std::fabs(report.conditions[c].flux[0] - flux));
        }
        EXPECT_TRUE(off < 1e-3 * all || !report.warnings.empty()) << constant << ' ' << off / all;
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
  // The mesh cannot be read again: there is no correction.
  MemorySource source(mesh);
  const std::unique_ptr<Solution> solution = solve(source, problem);
  Report report = solution->report();
  source.rewind(1000);
  ProblemResults results(source.info(), problem, *solution);
  for (MeshBlock block; source.next(block);)
  {
    results.add(block);
  }
  results.finish(report);
  EXPECT_TRUE(std::isnan(report.conditions[1].flux[0]));
  EXPECT_TRUE(std::isnan(report.balance[0]));
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_TRUE(contains(report.warnings[0], "the flux of dirichlet[0], dirichlet[1] is not known"))
    << report.warnings[0];
}

} // namespace
} // namespace smg::testing
