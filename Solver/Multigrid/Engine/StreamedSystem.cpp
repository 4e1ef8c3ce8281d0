// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/StreamedSystem.h"

#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Engine/Pass.h"

#include <utility>

namespace smg
{

StreamedSystem::StreamedSystem(
  CompiledOperators operators, int columns, const SolveOptions& options)
  : Operators(std::move(operators))
  , Context(std::make_unique<SolveContext>(columns, options))
  , Levels(*this->Context, columns, this->Operators.relaxation)
{
}

ColumnResiduals StreamedSystem::build(
  MeshSource& mesh, Problem& problem, RowListener* listener, std::int64_t furtherCoreBytes)
{
  return FirstPass(*this->Context, this->Levels, this->Operators)
    .run(mesh, problem, listener, furtherCoreBytes);
}

void StreamedSystem::advance(NextSystem& next)
{
  this->Levels.renew(next.columns());
  next.startPass();
  Pass(*this->Context, this->Levels).run(next.scale(), { .next = &next });
  next.endPass();
}

void StreamedSystem::restart(NextSystem& next)
{
  this->Levels.abandon();
  if (this->Context->scratch)
  {
    this->advance(next);
    return;
  }
  LevelWindow<double>& window = this->window();
  window.setColumns(next.columns());
  next.startPass();
  next.load();
  next.fill(window.nodes());
  next.endPass();
  Pass(*this->Context, this->Levels).begin();
}

void StreamedSystem::begin(
  Convergence& convergence, const Stopping& stopping, const FirstResidual& first)
{
  convergence = Convergence(stopping, first);
  convergence.begin(this->Levels.residualNorm(),
    !this->Context->components.shiftsRightSide() && !this->Context->flow);
  this->Context->endPass(convergence.initial());
}

std::unique_ptr<StreamedSolution> StreamedSystem::takeSolution()
{
  return std::make_unique<StreamedSolution>(std::move(this->Context), this->Levels.takeWindow());
}

} // namespace smg
