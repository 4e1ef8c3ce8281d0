// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/ContrastTesting.h"
#include "Testing/Support/QuadrupleElements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

// How far the fluxes of a report are known, and what it says of that, against linear finite
// elements that are solved in quadruple precision: what is wrong is said, and what is right is not
// called unknown.

namespace smg::testing
{
namespace
{

/** The sum of the magnitudes of the fluxes. */
double allOf(const ExactResults& exact)
{
  double all = 0.0;
  for (const auto& [name, flux] : exact.flux)
  {
    all += std::fabs(flux);
  }
  return all;
}

bool mentions(const Report& report, const std::string& words)
{
  return std::ranges::any_of(
    report.warnings, [&](const std::string& warning) { return contains(warning, words); });
}

/** Expects that fluxes are right to a thousandth of all that flows, or said to be known to less.
 * Returns the largest error, of all that flows; not a number if a flux is unknown. */
double expectRightOrSaid(const Report& report, const ExactResults& exact)
{
  const double all = allOf(exact);
  const bool says = !report.warnings.empty() || !report.converged;
  double largest = 0.0;
  for (const Report::Condition& condition : report.conditions)
  {
    const double error = std::fabs(condition.flux[0] - exact.flux.at(condition.name)) / all;
    EXPECT_TRUE(std::isnan(error) ? says : error <= (says ? 0.2 : 1e-3))
      << condition.name << ' ' << error;
    largest = std::isnan(error) || error > largest ? error : largest;
  }
  return largest;
}

void addToValues(ElementProblem& problem, double constant)
{
  const auto add = [constant](std::function<Eigen::VectorXd(const Point&)>& value)
  {
    value = [constant, before = value](const Point& x)
    { return Eigen::VectorXd(before(x).array() + constant); };
  };
  for (ElementProblem::Dirichlet& end : problem.DirichletConditions)
  {
    add(end.value);
  }
  for (ElementProblem::Robin& robin : problem.RobinConditions)
  {
    add(robin.ambient);
  }
}

/** What flows does not depend on a constant that is added to all values, or it is said by how much:
 * however close the values are to each other beside their size. */
TEST(ContrastFluxes, ValuesThatDifferLittleAreNotOne)
{
  int known = 0, lost = 0;
  forShapes({ 1.0, 1e4, 1e9 },
    [&](ElementProblem& problem, const std::string&)
    {
      const ExactResults exact = solveInQuadruple(problem);
      double added = 0.0;
      for (const double constant : { 1e6, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15 })
      {
        SCOPED_TRACE(constant);
        addToValues(problem, constant - added);
        added = constant;
        const Report report = resultsOf(problem);
        const double error = expectRightOrSaid(report, exact);
        known += error <= 1e-3 ? 1 : 0;
        lost += std::isnan(error) ? 1 : 0;
        // That the iteration stops at rounding is no reason to let it run on.
        EXPECT_FALSE(constant >= 1e9 && mentions(report, "a smaller tolerance"));
        EXPECT_EQ(mentions(report, "take off"), error <= 0.2 && !report.warnings.empty());
      }
    });
  EXPECT_GT(known, 150);
  EXPECT_GT(lost, 50);
}

/** A condition that varies by itself. */
TEST(ContrastFluxes, ValuesOfOneConditionThatDifferLittleAreNotOne)
{
  forShapes({ 1.0, 1e4, 1e9 },
    [](ElementProblem& problem, const std::string&)
    {
      const bool isRobin = !problem.RobinConditions.empty();
      const auto value = [](double constant)
      {
        return [constant](const Point& x)
        { return Eigen::VectorXd::Constant(1, constant + (x[0] < 4.0 ? 0.0 : 1.0)); };
      };
      const auto ends = [&mesh = problem.mesh()](const Point& x)
      { return x[0] < 1.5 || x[0] > (mesh.cellType == CellType::Triangle ? 14.5 : 6.5); };
      double through = 0.0;
      for (const double constant : { 0.0, 1e6, 1e9, 1e12, 1e14 })
      {
        SCOPED_TRACE(constant);
        problem.DirichletConditions.clear();
        problem.RobinConditions.clear();
        if (isRobin)
        {
          problem.RobinConditions = { { ends, [](const Point&) { return 0.1; }, value(constant) } };
        }
        else
        {
          problem.DirichletConditions = { { ends, value(constant) } };
        }
        const Report report = resultsOf(problem);
        through = constant == 0.0 ? 2.0 * report.energy[0] : through;
        // It has no flux as a whole.
        const double off = std::fabs(report.conditions[0].flux[0]) / through;
        EXPECT_TRUE(off <= 1e-3 || !report.warnings.empty()) << off;
        EXPECT_TRUE(constant > 0.0 || report.warnings.empty());
      }
    });
}

/** What holds a body may be as weak as can be: the rounding of values moves more than flows from
 * vertex to vertex, and none of it away. */
TEST(ContrastFluxes, LooselyHeldBodiesHaveTheirFluxes)
{
  int known = 0, count = 0;
  forShapes({ 1.0, 1e6 },
    [&](ElementProblem& problem, const std::string&)
    {
      const double middle = problem.mesh().cellType == CellType::Triangle ? 8.0 : 4.0;
      for (const double coefficient : { 1e-9, 1e-12, 1e-15 })
      {
        SCOPED_TRACE(coefficient);
        problem.DirichletConditions.clear();
        problem.RobinConditions.clear();
        for (const double value : { 0.0, 100.0 })
        {
          problem.RobinConditions.push_back(
            { value == 0.0 ? below(0, 0.5) : above(0, 2.0 * middle - 0.5),
              [coefficient](const Point&) { return coefficient; },
              [value](const Point&) { return Eigen::VectorXd::Constant(1, value); } });
        }
        const ExactResults exact = solveInQuadruple(problem);
        SolveOptions loose, few;
        loose.tolerance = 1e-2;
        few.maxCycles = 3;
        for (const SolveOptions& options : { loose, few })
        {
          expectRightOrSaid(resultsOf(problem, options), exact);
        }
        const Report report = resultsOf(problem);
        const double error = expectRightOrSaid(report, exact);
        ++count;
        known += error <= 1e-6 ? 1 : 0;
        EXPECT_TRUE(error <= 1e-6) << error;
        EXPECT_TRUE(!report.converged || report.warnings.empty());
      }
    });
  EXPECT_GE(known, count);
}

/** What rounding takes from the fluxes of one body is said of these alone. */
TEST(ContrastFluxes, BodiesAreJudgedApart)
{
  const IndexedTestMesh one = grid(17, 13, 0.1);
  for (const double contrast : { 1e7, 1e10, 1e14 })
  {
    for (const double scale : { 1e-6, 1.0, 1e6 })
    {
      SCOPED_TRACE(scientific(contrast) + ' ' + scientific(scale));
      const StreamMesh mesh = toStream(disjointUnion(one, one, { 100, 0, 0 }));
      ElementProblem problem(mesh);
      problem.Parts = 2;
      problem.Part = [](const Point& x) { return x[0] > 8.0 && x[0] < 50.0 ? 1 : 0; };
      problem.Conductivity = [&](const Point& x) -> Eigen::Matrix3d
      { return (problem.Part(x) == 0 ? 1.0 : contrast) * Eigen::Matrix3d::Identity(); };
      hold(problem, below(0, 0.5), 0.0);
      hold(
        problem, [](const Point& x) { return x[0] > 15.5 && x[0] < 50.0; }, 1.0);
      hold(
        problem, [](const Point& x) { return x[0] > 50.0 && x[0] < 100.5; }, 0.0);
      hold(problem, above(0, 115.5), scale);
      const Report report = resultsOfOneReading(problem);
      const ExactResults exact = solveInQuadruple(problem);
      expectRightOrSaid(report, exact);
      for (const std::size_t c : { 2, 3 })
      {
        const double flux = exact.flux.at(report.conditions[c].name);
        EXPECT_NEAR(report.conditions[c].flux[0] / flux, 1.0, 1e-6);
        EXPECT_FALSE(mentions(report, report.conditions[c].name));
      }
      EXPECT_EQ(std::isnan(report.conditions[1].flux[0]), contrast > 1e12);
      EXPECT_EQ(std::isnan(report.balance[0]), contrast > 1e12);
    }
  }
}

/** Any number of bodies, in any order, whose conditions span them all. */
TEST(ContrastFluxes, OfManyBodiesDependOnNoBlocks)
{
  // Strips of 3 x 2 vertices, more than are judged apart.
  const IndexedTestMesh strip = grid(3, 2, 0.1);
  IndexedTestMesh all = strip;
  all.positions.clear();
  all.corners.clear();
  for (int body = 0; body < BodyFlows::mostLabels(1) + 100; ++body)
  {
    const auto first = static_cast<std::int64_t>(all.positions.size() / 3);
    for (std::size_t e = 0; e < strip.positions.size(); ++e)
    {
      all.positions.push_back(strip.positions[e] + (e % 3 == 1 ? 10.0 * body : 0.0));
    }
    std::ranges::transform(strip.corners, std::back_inserter(all.corners),
      [first](std::int64_t corner) { return first + corner; });
  }
  // In a random order, corners get labels that are joined later.
  for (const StreamMesh& mesh : { toStream(all), toStream(shuffled(all), TestOrder::Keep) })
  {
    ElementProblem problem(mesh);
    hold(problem, below(0, 0.6), 0.0);
    hold(problem, above(0, 1.4), 1.0);
    const Report report = resultsOf(problem), other = resultsOf(problem, {}, 37);
    EXPECT_EQ(report.warnings, std::vector<std::string>());
    EXPECT_NEAR(report.conditions[1].flux[0] / 2.0 / report.energy[0], 1.0, 1e-6);
    EXPECT_EQ(other.conditions[1].flux, report.conditions[1].flux);
    EXPECT_EQ(other.balance, report.balance);
  }
}

} // namespace
} // namespace smg::testing
