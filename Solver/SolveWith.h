// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/PoissonSolver.h"
#include "Solver/Operators/OperatorSet.h"
#include "Solver/Solve.h"

#include <memory>

namespace smg
{

/**
 * Solves as solve() does, with an operator set of your own: a type that satisfies OperatorSet, of
 * which all of the multigrid is compiled here. `options.operators` is not looked at.
 *
 * A program that includes this file needs GCC or Clang and links StreamingMultigrid::Engine, which
 * says how kernels are to be compiled so that every machine gives the same bits.
 *
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
