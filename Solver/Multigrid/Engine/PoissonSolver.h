// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "Solver/Multigrid/Engine/ErrorBalance.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "smg/Solve.h"

#include <memory>
#include <utility>

namespace smg
{

/** Solves one problem: the first pass, then a pass for each V-cycle. The parts are the ones that
 * a deformation composes differently: SolveContext, Hierarchy, FirstPass, Iteration,
 * StreamedSolution. */
class PoissonSolver
{
public:
  /** Prepares for a problem of `columns` columns; nothing is read yet. */
  PoissonSolver(CompiledOperators operators, int columns, const SolveOptions& options)
    : Set(std::move(operators))
    , Run(std::make_unique<SolveContext>(columns, options))
    , Levels(*this->Run, columns, this->Set.relaxation)
  {
  }

  PoissonSolver(const PoissonSolver&) = delete;
  PoissonSolver& operator=(const PoissonSolver&) = delete;

  /** To be called once. */
  std::unique_ptr<Solution> solve(MeshSource& mesh, Problem& problem);

  SolveContext& run() { return *this->Run; }

private:
  EnergySquares discretisation(Problem& problem);

  CompiledOperators Set;
  std::unique_ptr<SolveContext> Run;
  Hierarchy Levels;
};

} // namespace smg
