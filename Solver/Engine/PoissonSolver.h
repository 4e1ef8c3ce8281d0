// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Convergence.h"
#include "Solver/Engine/FirstPass.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/Iteration.h"
#include "Solver/Engine/SolveRun.h"
#include "Solver/Engine/StreamedSolution.h"

#include <memory>
#include <utility>

namespace smg
{

/** Solves one problem: the first pass, then a pass for each V-cycle. */
template <OperatorSet Operators>
class PoissonSolver
{
public:
  /** Prepares for a problem of `columns` columns. Nothing is read yet. */
  PoissonSolver(Operators operators, int columns, const SolveOptions& options)
    : Set(std::move(operators))
    , Run(std::make_unique<SolveRun>(columns, options))
    , Levels(*this->Run, columns)
  {
  }

  PoissonSolver(const PoissonSolver&) = delete;
  PoissonSolver& operator=(const PoissonSolver&) = delete;

  /** To be called once. */
  std::unique_ptr<Solution> solve(MeshSource& mesh, Problem& problem);

  SolveRun& run() { return *this->Run; }

private:
  Operators Set;
  std::unique_ptr<SolveRun> Run;
  Hierarchy<typename Operators::Relaxation> Levels;
};

template <OperatorSet Operators>
std::unique_ptr<Solution> PoissonSolver<Operators>::solve(MeshSource& mesh, Problem& problem)
{
  SolveRun& run = *this->Run;
  run.beginReport();
  const Stopping stopping{ run.options.tolerance, run.options.maxCycles };
  run.progress.begin(stopping, 0.0, 1.0, true);
  Convergence convergence(stopping, {});
  Iteration iteration(run, this->Levels, convergence);
  const auto exchange = [&](auto& state) { state(this->Levels, convergence, iteration); };
  if (!run.resume({ { "kind of task", "solve" } }, { exchange, exchange }))
  {
    const FirstResidual first = FirstPass(run, this->Levels, this->Set)(mesh, problem);
    convergence = Convergence(stopping, first);
    convergence.begin(this->Levels.residualNorm(), run.components.incompatibility() == 0.0);
    run.endPass(1.0);
  }
  iteration(false);
  Report& r = run.report;
  r.cycles = convergence.cycles();
  r.residuals = convergence.residuals();
  r.converged = convergence.converged();
  convergence.addNotes(r.notes, "");
  run.free.fixMeans(this->Levels.window(), r.notes);
  r.seconds.solve = run.seconds() - r.seconds.build;
  run.finishReport();
  auto solution =
    std::make_unique<StreamedSolution>(std::move(this->Run), this->Levels.takeWindow());
  run.progress.finish();
  return solution;
}

} // namespace smg
