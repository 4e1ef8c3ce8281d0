// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/Corrections.h"
#include "Solver/Multigrid/Engine/ErrorBalance.h"
#include "Solver/Multigrid/Engine/StreamedSystem.h"
#include "smg/Solve.h"

#include <memory>
#include <utility>

namespace smg
{

/** Solves one problem: the first pass, then a pass for each V-cycle. */
class PoissonSolver
{
public:
  /** Prepares for a problem of `columns` columns; nothing is read yet. */
  PoissonSolver(CompiledOperators operators, int columns, const SolveOptions& options)
    : System(std::move(operators), columns, options)
  {
  }

  PoissonSolver(const PoissonSolver&) = delete;
  PoissonSolver& operator=(const PoissonSolver&) = delete;

  /** To be called once. */
  std::unique_ptr<Solution> solve(MeshSource& mesh, Problem& problem);
  /** Instead: solves for what is to be added to this solution of the problem, until the residual,
   * with these scales of columns, is at most `goal`. */
  std::unique_ptr<Solution> correct(MeshSource& mesh, Problem& problem, Solution& solution,
    double goal, const ColumnScales& scales);

  SolveContext& context() { return this->System.context(); }

  // Afterwards:

  /** How far the progress has come: 1 unless a correction is likely to follow. */
  double done() const { return this->Done; }
  const SolveNorms& norms() const { return this->Norms; }
  /** The bytes of the pool and of scratch files that the solution has. */
  std::int64_t usedBytes() const { return this->Used; }
  std::int64_t usedScratch() const { return this->ScratchUsed; }

private:
  EnergySquares discretisation(Problem& problem);
  std::unique_ptr<Solution> finish(
    const Convergence& convergence, Problem& problem, const ErrorBalance* balance);

  StreamedSystem System;
  SolveNorms Norms;
  double Done = 1.0;
  std::int64_t Used = 0, ScratchUsed = 0;
};

} // namespace smg
