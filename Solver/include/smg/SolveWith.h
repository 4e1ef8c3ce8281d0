// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/CheckOptions.h"
#include "Solver/Engine/Engine.txx"
#include "Solver/Operators/Extended.h"
#include "Solver/Operators/OperatorSet.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/**
 * Like solve(), with a user-defined operator set: a type that satisfies the concept OperatorSet
 * (see Solver/Operators/OperatorSet.h), for which the multigrid is compiled here.
 * `options.operators` is ignored.
 *
 * A program that includes this file needs GCC or Clang and links StreamingMultigrid::Engine, which
 * provides the sources of the engine, whose names may change with any version, and the compiler
 * flags for identical bits on all machines.
 *
 * @return the solution, `problem.columns()` values per vertex
 * @throws Error, Cancelled like solve()
 */
template <OperatorSet Operators>
std::unique_ptr<Solution> solveWith(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {})
{
  checkOptions(options);
  checkProblem(problem);
  auto engine = std::make_unique<Engine<Operators>>(problem.columns(), options);
  engine->solve(mesh, problem);
  return engine;
}

} // namespace smg
