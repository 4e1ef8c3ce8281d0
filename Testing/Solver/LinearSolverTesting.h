// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Extended.h"
#include "Testing/Solver/SolveTesting.h"
#include "smg/LinearSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace smg::testing
{

using Numbers = std::vector<double>;

/** Keeps the loads of a problem, as a first pass sums them up. */
class Loads : public RowListener
{
public:
  explicit Loads(int columns)
    : Columns(columns)
  {
  }
  void link(std::int32_t /*delta*/, double /*weight*/) override {}
  void constraint(const double* sum) override
  {
    this->Sums.insert(this->Sums.end(), sum, sum + this->Columns);
  }
  void close(const double* /*point*/, std::int64_t /*reach*/) override {}

  const Numbers& sums() const { return this->Sums; }

private:
  int Columns;
  Numbers Sums;
};

/** b and x_0 of a problem. */
struct Sides
{
  Numbers b, x;
};

/** The loads of the unknowns and the values of other vertices, and the initial values. */
inline Sides sidesOf(const StreamMesh& mesh, ArrayProblem problem)
{
  problem.Value.resize(static_cast<std::size_t>(problem.Columns * mesh.vertices()));
  Sides sides{ {}, problem.Value };
  const auto columns = static_cast<std::size_t>(problem.Columns);
  for (std::size_t i = 0; i < problem.Value.size(); ++i)
  {
    if (!problem.Prescribed.empty() && problem.Prescribed[i / columns])
    {
      problem.Value[i] = 0.0; // so that it adds nothing to its neighbours
    }
  }
  SolveOptions options;
  options.inCore = true;
  const CompiledOperators set = compiled(Extended::forCells(mesh.cellType));
  SolveContext run(problem.Columns, options);
  Hierarchy levels(run, problem.Columns, set.relaxation);
  Loads loads(problem.Columns);
  MemorySource source(mesh);
  FirstPass(run, levels, set).run(source, problem, &loads);
  sides.b = loads.sums();
  for (std::size_t i = 0; i < sides.b.size(); ++i)
  {
    if (!problem.Prescribed.empty() && problem.Prescribed[i / columns])
    {
      sides.b[i] = sides.x[i];
    }
  }
  return sides;
}

/** Values of a solver, one row per vertex. */
inline Eigen::MatrixXd tableOf(const Numbers& values, std::int64_t vertices)
{
  return Eigen::Map<const Eigen::MatrixXd>(
    values.data(), static_cast<Eigen::Index>(values.size()) / vertices, vertices)
    .transpose();
}

inline double dot(const Numbers& a, const Numbers& b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

inline double normOf(const Numbers& a)
{
  return std::sqrt(dot(a, a));
}

inline Numbers randomNumbers(std::int64_t count, std::uint64_t seed)
{
  Random random(seed);
  Numbers numbers(static_cast<std::size_t>(count));
  std::ranges::generate(numbers, [&] { return random.uniform(-1.0, 1.0); });
  return numbers;
}

/** A x, and M r. */
inline Numbers product(LinearSolver& solver, const Numbers& x)
{
  Numbers y(x.size());
  solver.multiply(x, y);
  return y;
}
inline Numbers preconditioned(LinearSolver& solver, const Numbers& r)
{
  Numbers z(r.size());
  solver.precondition(r, z);
  return z;
}

/** b - A x */
inline Numbers residualOf(LinearSolver& solver, const Numbers& b, const Numbers& x)
{
  Numbers r = product(solver, x);
  std::ranges::transform(b, r, r.begin(), std::minus());
  return r;
}

inline ArrayProblem posed(const StreamMesh& mesh, int columns, Weights weights, bool isScreened)
{
  ArrayProblem problem = heldEnds(mesh, columns, weights);
  problem.Screening = isScreened ? 50.0 : 0.0;
  problem.Source = randomNumbers(columns * mesh.vertices(), 3);
  return problem;
}

inline SolveOptions solverOptions(double tolerance = 1e-8)
{
  SolveOptions options = accurate(tolerance);
  options.inCore = true;
  options.coreNodes = 500; // so that there are levels in passes, and one that is iterated
  return options;
}

/** Expects the bits of solve(), with the same residuals, of a LinearSolver or a SystemOnDisk. */
template <class Solver>
void expectSame(Solver& solver, const StreamMesh& mesh, ArrayProblem problem, SolveOptions options,
  double tolerance)
{
  options.tolerance = tolerance;
  const Solved expected = solveMesh(mesh, problem, options);
  Sides sides = sidesOf(mesh, problem);
  const Report& report = solver.solve(sides.b, sides.x, tolerance);
  EXPECT_TRUE(sameBits(tableOf(sides.x, mesh.vertices()), expected.values));
  EXPECT_EQ(report.residuals, expected.report.residuals);
  EXPECT_EQ(report.passes, expected.report.passes);
  EXPECT_EQ(report.cycles, expected.report.cycles);
  EXPECT_EQ(report.converged, expected.report.converged);
  EXPECT_EQ(report.acceleration, expected.report.acceleration);
  EXPECT_EQ(report.removed_source, expected.report.removed_source);
  EXPECT_EQ(report.notes, expected.report.notes);
  EXPECT_EQ(report.seconds.build, 0.0);
}

inline std::vector<StreamMesh> solverMeshes()
{
  return { toStream(torus(90, 45, 0.3)), toStream(tetBox(12, 11, 10, 0.15)),
    toStream(gridWithNeedle(40, 30, 1e-4)) };
}

} // namespace smg::testing
