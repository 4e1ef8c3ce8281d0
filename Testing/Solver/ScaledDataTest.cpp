// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/EllipticTesting.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

// A problem in other units has the solution in other units. Where numbers leave the range of double
// or single precision, there is an error, never a wrong number.

namespace smg::testing
{
namespace
{

double bump(const Point& p, int)
{
  return std::sin(0.7 * p[0]) + 0.3 * std::cos(p[1] - 0.5 * p[2]) + 2.0;
}

/** Data of which some are `unit` times those of unit 1. */
struct ScaledDatum
{
  std::string name;
  std::function<void(ElementProblem&, double unit)> set;
  int power = 1; ///< the solution is unit^power times that of unit 1
  bool lengths = false;
};

ElementProblem::Values bumpTimes(double unit)
{
  return columnsOf(1, [unit](const Point& p, int k) { return unit * bump(p, k); });
}

void holdEnds(ElementProblem& p, double unit)
{
  p.DirichletConditions.push_back({ below(0, 0.6), bumpTimes(unit) });
  p.DirichletConditions.push_back({ above(0, 5.0), bumpTimes(-unit) });
}

void holdAtZero(ElementProblem& p)
{
  p.DirichletConditions.push_back(
    { below(0, 0.6), columnsOf(1, [](const Point&, int) { return 0.0; }) });
}

void setConductivity(ElementProblem& p, double unit)
{
  p.Conductivity = [unit](const Point& x) -> Eigen::Matrix3d { return unit * someTensor(x); };
}

/** Values to which the solution is proportional. */
std::vector<ScaledDatum> scaledValues()
{
  return {
    { "prescribed values", holdEnds },
    { "sources at vertices",
      [](ElementProblem& p, double unit)
      {
        holdAtZero(p);
        p.VertexSource = bumpTimes(unit);
      } },
    { "sources in cells",
      [](ElementProblem& p, double unit)
      {
        holdAtZero(p);
        p.CellSource = bumpTimes(unit);
      } },
    { "sources that do not sum to zero",
      [](ElementProblem& p, double unit) { p.VertexSource = bumpTimes(unit); } },
    { "fluxes",
      [](ElementProblem& p, double unit)
      {
        holdAtZero(p);
        p.FluxConditions.push_back({ above(0, 4.0), bumpTimes(unit) });
      } },
    { "fields",
      [](ElementProblem& p, double unit)
      {
        holdAtZero(p);
        p.CellField = [unit](const Point& x) -> Eigen::MatrixXd
        { return unit * Eigen::Vector3d(x[1], 2.0, std::sin(x[0])); };
      } },
    { "ambient values",
      [](ElementProblem& p, double unit)
      {
        p.RobinConditions.push_back(
          { above(0, 4.0), [](const Point&) { return 2.0; }, bumpTimes(unit) });
      } },
    { "all values and initial ones",
      [](ElementProblem& p, double unit)
      {
        holdEnds(p, unit);
        p.VertexSource = p.CellSource = p.Initial = bumpTimes(unit);
        p.RobinConditions.push_back(
          { above(1, 3.0), [](const Point&) { return 2.0; }, bumpTimes(unit) });
      } },
  };
}

/** Data of the operator, and initial values. */
std::vector<ScaledDatum> scaledOperators()
{
  return {
    { "initial values",
      [](ElementProblem& p, double unit)
      {
        holdEnds(p, 1.0);
        p.Initial = bumpTimes(unit);
      },
      0 },
    { "conductivity",
      [](ElementProblem& p, double unit)
      {
        holdEnds(p, 1.0);
        setConductivity(p, unit);
      },
      0 },
    { "conductivity beside sources",
      [](ElementProblem& p, double unit)
      {
        holdAtZero(p);
        setConductivity(p, unit);
        p.VertexSource = bumpTimes(1.0);
      },
      -1 },
    { "the equation",
      [](ElementProblem& p, double unit)
      {
        setConductivity(p, unit);
        p.VertexScreening = [unit](const Point&) { return 0.1 * unit; };
        p.VertexSource = bumpTimes(unit);
        p.RobinConditions.push_back(
          { above(1, 3.0), [unit](const Point&) { return 2.0 * unit; }, bumpTimes(1.0) });
      },
      0 },
    { "lengths",
      [](ElementProblem& p, double unit)
      {
        p.DirichletConditions.push_back({ [unit](const Point& x) { return x[0] < 0.6 * unit; },
          columnsOf(1, [unit](const Point& x, int k) { return bump(x / unit, k); }) });
      },
      0, true },
    { "lengths beside sources",
      [](ElementProblem& p, double unit)
      {
        p.DirichletConditions.push_back({ [unit](const Point& x) { return x[0] < 0.6 * unit; },
          columnsOf(1, [](const Point&, int) { return 0.0; }) });
        p.VertexSource = columnsOf(1, [unit](const Point& x, int k) { return bump(x / unit, k); });
      },
      2, true },
  };
}

std::vector<ScaledDatum> scaledData()
{
  std::vector<ScaledDatum> data = scaledValues();
  const std::vector<ScaledDatum> operators = scaledOperators();
  data.insert(data.end(), operators.begin(), operators.end());
  return data;
}

Eigen::MatrixXd solutionOfUnit(const ScaledDatum& scaling, const StreamMesh& mesh)
{
  ElementProblem problem(mesh);
  scaling.set(problem, 1.0);
  return DirectElements(problem).solve();
}

/** What becomes of a unit: "solved" if the solution is right, the first words of the error, or what
 * is wrong. */
std::string outcomeOf(
  const ScaledDatum& scaling, StreamMesh mesh, double unit, const Eigen::MatrixXd& expected)
{
  for (double& coordinate : mesh.positions)
  {
    coordinate *= scaling.lengths ? unit : 1.0;
  }
  ElementProblem problem(mesh);
  scaling.set(problem, unit);
  try
  {
    const Solved solved = solveMesh(mesh, problem, accurate(1e-9));
    Eigen::MatrixXd values = solved.values;
    for (int k = 0; k < std::abs(scaling.power); ++k)
    {
      values =
        (scaling.power > 0 ? Eigen::MatrixXd(values / unit) : Eigen::MatrixXd(values * unit));
    }
    const double error = relativeError(values, expected);
    return error < 1e-6              ? "solved"
           : solved.report.converged ? "WRONG by " + std::to_string(error)
                                     : "not converged";
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

} // namespace

TEST(ScaledDataLaw, TheSolutionScalesOrThereIsAnError)
{
  // Ordinary units are solved.
  for (const StreamMesh& mesh : { patch(9, 8), block(5, 4, 4) })
  {
    for (const ScaledDatum& datum : scaledData())
    {
      const Eigen::MatrixXd expected = solutionOfUnit(datum, mesh);
      for (int exponent = -320; exponent <= 300; exponent += 20)
      {
        const std::string outcome = outcomeOf(datum, mesh, std::pow(10.0, exponent), expected);
        const std::string name = datum.name + " 1e" + std::to_string(exponent);
        EXPECT_EQ(outcome.find("WRONG"), std::string::npos) << name << " " << outcome;
        EXPECT_TRUE(outcome == "solved" || exponent != 0) << name << " " << outcome;
      }
    }
  }
}

/** Beside ordinary values. */
TEST(ScaledData, AFewTinyValuesAndCellsAreNoError)
{
  StreamMesh mesh = toStream(disjointUnion(grid(9, 8, 0.2), grid(2, 2, 0.0), { 20, 0, 0 }));
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    double* p = &mesh.positions[3 * v];
    if (p[0] > 15)
    {
      p[0] = (p[0] - 20) * 1e-90;
      p[1] *= 1e-90;
    }
  }
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back({ above(0, 0.6), columnsOf(1, bump) });
  problem.VertexSource = columnsOf(1, [](const Point&, int) { return 1e-200; });
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_TRUE(solved.report.converged);
}

} // namespace smg::testing
