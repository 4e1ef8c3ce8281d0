// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/PoissonSolver.h"

#include "Solver/Files/ScratchAccount.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/Iteration.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

namespace smg
{

std::unique_ptr<Solution> PoissonSolver::solve(MeshSource& mesh, Problem& problem)
{
  SolveContext& context = this->System.context();
  context.beginReport();
  std::optional<ErrorBalance> balance;
  if (context.options.tolerance == SolveOptions::AutomaticTolerance)
  {
    context.energy.emplace(problem.columns());
    balance.emplace([&] { return this->discretisation(problem); });
  }
  context.mayMeasureFlow = !balance;
  context.couplings = problem.couplings();
  constexpr double Least = 1e-13; // the tolerance if it is automatic
  const Stopping stopping{ balance ? Least : context.options.tolerance, context.options.maxCycles };
  context.progress.begin(
    { balance ? ErrorBalance::UsualResidual : stopping.tolerance, stopping.maxCycles }, 0.0, 1.0,
    true);
  Convergence convergence(stopping, {});
  Iteration iteration(
    context, this->System.levels(), convergence, "", balance ? &*balance : nullptr);
  // What a checkpoint has of this solve, in the order in which it is saved and restored.
  const auto exchange = [&](auto& state)
  {
    state(this->System.levels(), context.scales, convergence, iteration);
    if (balance)
    {
      state(*context.energy, *balance);
    }
  };
  if (!context.resume({ { "kind of task", "solve" } }, { exchange, exchange }))
  {
    const ColumnResiduals first = this->System.build(mesh, problem);
    if (!problem.beginsAtRest())
    {
      context.scales = ColumnScales(first.references, problem.vectorSize());
    }
    this->System.begin(
      convergence, stopping, problem.beginsAtRest() ? first.alone() : context.scales.of(first));
  }
  iteration.run(false);
  return this->finish(convergence, problem, balance ? &*balance : nullptr);
}

std::unique_ptr<Solution> PoissonSolver::correct(
  MeshSource& mesh, Problem& problem, Solution& solution, double goal, const ColumnScales& scales)
{
  // At least this share of the residual is to go, whose digits a double has.
  constexpr double Most = 0.1, Least = 1e-12;
  SolveContext& context = this->System.context();
  context.beginReport();
  context.corrected = &solution;
  context.couplings = problem.couplings();
  context.scales = scales;
  context.progress.begin({ Least, context.options.maxCycles }, 0.0, 1.0, true);
  FirstResidual first = scales.of(this->System.build(mesh, problem));
  first.reference = first.norm; // it is measured against itself
  const Stopping stopping{ first.norm > 0.0 ? std::clamp(goal / first.norm, Least, Most) : Most,
    context.options.maxCycles };
  Convergence convergence(stopping, first);
  Iteration iteration(context, this->System.levels(), convergence);
  this->System.begin(convergence, stopping, first);
  iteration.run(false);
  return this->finish(convergence, problem, nullptr);
}

/** To be called after the last pass: makes the solution, with its report. */
std::unique_ptr<Solution> PoissonSolver::finish(
  const Convergence& convergence, Problem& problem, const ErrorBalance* balance)
{
  SolveContext& context = this->System.context();
  this->Norms = { convergence.reference(), convergence.norm(), convergence.rounding(),
    context.flow ? context.flowNorm() : 0.0, context.scales };
  Report& r = context.report;
  r.cycles = convergence.cycles();
  r.residuals = convergence.residuals();
  r.relative_to = problem.beginsAtRest() ? MeshAtRest : BestConstant;
  r.converged = convergence.converged();
  convergence.addNotes(r, "");
  if (balance)
  {
    balance->report(r);
  }
  context.free.fix(this->System.window(), problem, r);
  r.seconds.solve = context.seconds() - r.seconds.build;
  context.finishReport();
  auto solution = this->System.takeSolution();
  context.progress.finish();
  this->Done = context.progress.done();
  this->Used = context.pool.used();
  this->ScratchUsed = context.scratch ? context.scratch->account().used() : 0;
  return solution;
}

/** Reads the mesh once more to estimate the discretisation error, with the iterate of the last
 * pass. */
EnergySquares PoissonSolver::discretisation(Problem& problem)
{
  SolveContext& context = this->System.context();
  const std::unique_ptr<MeshSource> mesh = context.options.again();
  context.free.prepare();
  try
  {
    DiscretisationError error(context.pool, mesh->info(), problem,
      [this, &context](std::int64_t first, std::int64_t count, std::span<double> values)
      { context.readCompleted(this->System.window(), first, count, values); });
    for (MeshBlock block; mesh->next(block);)
    {
      error.add(block);
      context.progress.update(1.0); // may cancel
    }
    return error.finish();
  }
  catch (const MemoryLimitError& error)
  {
    throw context.explained(error);
  }
}

} // namespace smg
