// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Solution.h"
#include "Solver/Engine/SolveOptions.h"
#include "Solver/Problem/Problem.h"

#include <memory>

namespace smg
{

/** Throws Error if an option other than the operator set's name is out of range; solve() does so,
 * too. */
void checkOptions(const SolveOptions& options);
/** Throws Error unless the library has an operator set of that name, which goes with the other
 * options; solve() does so, too. */
void checkOperators(const SolveOptions& options);
/** Throws Error if the problem has no column; solve() does so, too. */
void checkProblem(const Problem& problem);

/**
 * Solves the problem on the mesh stream, which is read once.
 * @throws Error when an option is out of range, the stream or the problem is not valid, the memory
 * limit is below the need (at once, with both figures), or a scratch file fails; Cancelled when the
 * progress callback says so. No scratch file is left behind by a throw or by ~Solution.
 */
std::unique_ptr<Solution> solve(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {});

} // namespace smg
