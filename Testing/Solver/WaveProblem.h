// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/EllipticTesting.h"

#include <cmath>
#include <functional>

namespace smg::testing
{

/** Right-hand sides of the problems of the tests. */
inline constexpr int WaveColumns = 2;

/** A value at each point for column k. */
inline double wave(const Point& p, int k)
{
  return std::sin(0.7 * p[0] + k) + 0.3 * std::cos(p[1] - 0.5 * p[2]);
}

/** Sets every type of datum, and two adjacent Dirichlet conditions. */
inline void setEverything(ElementProblem& problem)
{
  const auto values = columnsOf(WaveColumns, wave);
  problem.Columns = WaveColumns;
  problem.Conductivity = someTensor;
  problem.VertexScreening = [](const Point& p) { return p[1] > 2 ? 0.3 : 0.0; };
  problem.CellScreening = [](const Point&) { return 0.1; };
  problem.VertexSource = problem.CellSource = values;
  problem.CellField = [](const Point& p) -> Eigen::MatrixXd
  { return Eigen::MatrixXd::Constant(3, WaveColumns, 0.4 * p[0]); };
  problem.DirichletConditions.push_back(
    { [](const Point& p) { return p[0] < 0.9 && p[1] < 2; }, values });
  problem.DirichletConditions.push_back({ below(0, 0.9), values });
  problem.FluxConditions.push_back({ above(0, 4.0), values });
  problem.RobinConditions.push_back(
    { above(1, 3.0), [](const Point& p) { return 1.0 + p[0]; }, values });
}

/** Sets the data of a problem. */
using Setting = std::function<void(ElementProblem&)>;

} // namespace smg::testing
