// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Solver/WaveProblem.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

// A constant that is added to all values of a problem changes its solution by the constant, and not
// how well it is solved: the tolerance is a share of what the solution varies by.

namespace smg::testing
{
namespace
{

/** Small differences of values around `offset`, given in different ways. */
std::vector<std::pair<std::string, Setting>> settings(double offset)
{
  const auto values = columnsOf(
    WaveColumns, [offset](const Point& p, int k) { return offset * (k + 1) + wave(p, k); });
  const auto same =
    columnsOf(WaveColumns, [offset](const Point&, int k) { return offset * (k + 1); });
  const auto small = columnsOf(WaveColumns, wave);
  const auto factor = [](const Point&) { return 2.0; };
  return { { "values that differ",
             [=](ElementProblem& p) {
               p.DirichletConditions.push_back({ below(0, 0.9), values });
             } },
    { "one value, and a flux",
      [=](ElementProblem& p)
      {
        p.DirichletConditions.push_back({ below(0, 0.9), same });
        p.FluxConditions.push_back({ above(0, 4.0), small });
      } },
    { "the same value and ambient value, and sources",
      [=](ElementProblem& p)
      {
        p.Conductivity = someTensor;
        p.DirichletConditions.push_back({ below(0, 0.9), same });
        p.RobinConditions.push_back({ above(0, 4.0), factor, same });
        p.VertexSource = small;
      } },
    { "ambient values alone", [=](ElementProblem& p) {
       p.RobinConditions.push_back({ above(1, 3.0), factor, values });
     } } };
}

Solved solved(
  const StreamMesh& mesh, const Setting& set, const SolveOptions& options = SolveOptions())
{
  ElementProblem problem(mesh);
  problem.Columns = WaveColumns;
  set(problem);
  return solveMesh(mesh, problem, options);
}

/** Expects the rows of `found` below `end` to be those of `expected` and the offset. */
void expectShifted(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected, double offset,
  Eigen::Index end, const std::string& name)
{
  for (int k = 0; k < WaveColumns; ++k)
  {
    const Eigen::VectorXd of = expected.col(k).head(end);
    const Eigen::VectorXd shifted = found.col(k).head(end).array() - offset * (k + 1);
    EXPECT_LT((shifted - of).cwiseAbs().maxCoeff(), 1e-6 * (of.maxCoeff() - of.minCoeff())) << name;
  }
}

} // namespace

TEST(CommonOffset, DoesNotSpoilTheSolution)
{
  for (const StreamMesh& mesh : { patch(40, 30), block(12, 10, 11) })
  {
    for (const double offset : { 293.0, -1e4 })
    {
      const auto with = settings(offset), without = settings(0.0);
      for (std::size_t k = 0; k < with.size(); ++k)
      {
        const std::string name = with[k].first + " about " + std::to_string(offset);
        SolveOptions options;
        options.coreNodes = 100; // so that levels are streamed, too
        const Solved found = solved(mesh, with[k].second, options);
        EXPECT_TRUE(found.report.converged) << name;
        const Solved expected = solved(mesh, without[k].second, accurate(1e-12));
        expectShifted(found.values, expected.values, offset, found.values.rows(), name);
        options.blockNodes = 64;
        options.threads = 3;
        EXPECT_EQ(solved(mesh, with[k].second, options).values, found.values) << name;
        options.inCore = true;
        EXPECT_EQ(solved(mesh, with[k].second, options).values, found.values) << name;
      }
    }
  }
}

TEST(CommonOffset, IsNotMissedBesideBodiesThatNothingReaches)
{
  const StreamMesh mesh =
    toStream(disjointUnion(grid(30, 20, 0.2), grid(9, 7, 0.2), { 100, 0, 0 }));
  constexpr double Offset = 293.0;
  const auto set = [](double offset)
  {
    return [offset](ElementProblem& p)
    {
      p.DirichletConditions.push_back({ below(0, 0.9),
        columnsOf(WaveColumns, [offset](const Point&, int k) { return offset * (k + 1); }) });
      p.FluxConditions.push_back({ [](const Point& x) { return x[0] > 20 && x[0] < 50; },
        columnsOf(WaveColumns, [](const Point&, int) { return 1e-3; }) });
    };
  };
  const Solved found = solved(mesh, set(Offset));
  ASSERT_EQ(found.report.free_components, 1);
  Eigen::MatrixXd values = found.values;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < WaveColumns && mesh.positions[3 * v] > 50; ++k)
    {
      EXPECT_EQ(values(v, k), 0.0);
      values(v, k) = Offset * (k + 1);
    }
  }
  expectShifted(
    values, solved(mesh, set(0.0), accurate(1e-12)).values, Offset, values.rows(), "crumbs");
}

/** The solution differs from 0 by about as much as it varies: V-cycles end at the tolerance. */
TEST(CommonOffset, OfTheSizeOfTheValuesTakesNoFurtherCycles)
{
  for (const int n : { 30, 60, 120 })
  {
    const StreamMesh mesh = toStream(grid(n, n));
    ElementProblem problem(mesh);
    problem.DirichletConditions.push_back(
      { below(0, 0.5), [](const Point&) { return Eigen::VectorXd::Constant(1, 1.0); } });
    problem.VertexSource = [n](const Point&) { return Eigen::VectorXd::Constant(1, 8.0 / n / n); };
    const Report report = solveMesh(mesh, problem, SolveOptions()).report;
    ASSERT_GT(report.cycles, 1);
    EXPECT_GT(report.residuals[report.residuals.size() - 2], SolveOptions().tolerance);
  }
}

TEST(CommonOffset, OfInitialValuesNearTheSolutionIsNone)
{
  const StreamMesh mesh = patch();
  const Setting set = settings(293.0)[1].second;
  const auto near = [&](ElementProblem& p)
  {
    set(p);
    p.Initial = columnsOf(WaveColumns, [](const Point&, int k) { return 293.0 * (k + 1); });
  };
  const Report report = solved(mesh, near).report;
  EXPECT_GT(report.residuals[report.residuals.size() - 2], SolveOptions().tolerance);
  EXPECT_LE(report.cycles, solved(mesh, set).report.cycles);
}

TEST(CommonOffset, LowersTheGoalAsFarAsNumbersGo)
{
  const auto meets = [](double tolerance, double share, double norm)
  {
    Convergence convergence({ tolerance, 50 }, { 1.0, 0.0, 1.0 });
    convergence.begin(0.5);
    convergence.add(norm, 0.0, share);
    return convergence.converged();
  };
  EXPECT_TRUE(meets(1e-8, 0.2, 0.9e-8));
  EXPECT_TRUE(!meets(1e-8, 1e-3, 1.1e-11) && meets(1e-8, 1e-3, 0.9e-11));
  EXPECT_TRUE(!meets(1e-8, 0.0, 1.1e-12) && meets(1e-8, 0.0, 0.9e-12));
  EXPECT_TRUE(!meets(1e-13, 0.0, 1.1e-13) && meets(1e-13, 0.0, 0.9e-13));
}

TEST(CommonOffset, NeverTakesConvergenceAway)
{
  const std::vector<std::vector<double>> courses{ { 1e-4, 1e-7, 1e-9 }, { 1e-4, 9e-9, 1.1e-8 },
    { 1e-4, 9e-9, 8.9e-9, 1.1e-8 } };
  for (const std::vector<double>& norms : courses)
  {
    // At the most V-cycles, or as soon as it stagnates.
    Convergence convergence({ 1e-8, norms.size() == 3 ? 3 : 50 }, { 1.0, 0.0, 1.0 });
    convergence.begin(0.5);
    for (const double norm : norms)
    {
      EXPECT_FALSE(convergence.done());
      convergence.add(norm, 0.0, 1e-3);
    }
    EXPECT_TRUE(convergence.done() && convergence.converged());
    Report report;
    convergence.addNotes(report, "");
    ASSERT_EQ(report.notes.size(), 1U);
    EXPECT_TRUE(report.warnings.empty());
    EXPECT_NE(report.notes.front().find("little flows"), std::string::npos);
  }
}

TEST(CommonOffset, AnEndByRoundingAboveTheFirstResidualIsAWarning)
{
  for (const double factor : { 0.5, 2.0 })
  {
    Convergence convergence({ 1e-8, 50 }, { 1.0, 0.0, 1.0 });
    convergence.begin(5.0);
    while (!convergence.done())
    {
      convergence.add(factor, 10.0);
    }
    EXPECT_TRUE(convergence.converged());
    Report report;
    convergence.addNotes(report, "");
    EXPECT_EQ(report.notes.size(), 1U);
    EXPECT_EQ(report.warnings.size(), factor < 1.0 ? 0U : 1U);
  }
}

} // namespace smg::testing
