// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "Solver/Multigrid/Extended.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/RowOperators.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/**
 * As solve(), with an operator set of the program's own.
 *
 * A program that includes this file needs GCC or Clang, and links StreamingMultigrid::Engine: its
 * headers, whose names may change with any version, and the compiler flags by which every machine
 * computes the same bits.
 *
 * @tparam Operators a type that satisfies the concept OperatorSet (Solver/Multigrid/OperatorSet.h);
 * its steps and its sweep are compiled in the program, the rest of the multigrid is the library's
 * @param mesh the stream, read once
 * @param problem the problem
 * @param options how to solve; `operators` is ignored
 * @return the solution, problem.columns() values a vertex
 * @throws Error as solve()
 * @throws Cancelled as solve()
 */
template <OperatorSet Operators>
std::unique_ptr<Solution> solveWith(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {})
{
  return solveWith(compiled(Operators::forCells(mesh.info().cellType)), mesh, problem, options);
}

} // namespace smg
