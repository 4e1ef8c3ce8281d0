// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/CheckOptions.h"
#include "Solver/Engine/PoissonSolver.h"
#include "Solver/Operators/Extended.h"
#include "Solver/Operators/OperatorSet.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/**
 * Solves as solve() does, with an operator set of the program's own: a type that satisfies the
 * concept OperatorSet (see Solver/Operators/OperatorSet.h), for which the multigrid is compiled
 * here. `options.operators` is ignored.
 *
 * A program that includes this file needs GCC or Clang and links StreamingMultigrid::Engine, which
 * brings the sources of the engine, whose names may change with any version, and the flags by which
 * every machine computes the same bits.
 *
 * @return the solution, `problem.columns()` values a vertex
 * @throws Error, Cancelled as solve()
 */
template <OperatorSet Operators>
std::unique_ptr<Solution> solveWith(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {})
{
  checkOptions(options);
  checkProblem(problem);
  PoissonSolver<Operators> solver(
    Operators::forCells(mesh.info().cellType), problem.columns(), options);
  return solver.solve(mesh, problem);
}

} // namespace smg
