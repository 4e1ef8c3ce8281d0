// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Iteration.h"

#include "Solver/Multigrid/Engine/Pass.h"

#include <cstdint>

namespace smg
{

void Iteration::run(bool leaveLast)
{
  Pass pass(this->Context, this->Levels);
  while (!this->StoppingRule.done() && !(leaveLast && this->StoppingRule.isLast()))
  {
    const bool measures = this->measuresMemory();
    if (!measures)
    {
      this->Accelerator.decide();
      this->addHistory();
    }
    if (this->History)
    {
      this->History->startPass(this->Accelerator.next(this->History->products()));
    }
    // The peak of this pass alone, should it be the one that measures.
    this->Context.pool.restartPeak();
    pass.run(this->StoppingRule.norm(),
      { .history = this->History ? &*this->History : nullptr, .inOneChain = measures });
    if (measures)
    {
      this->HasMeasured = true;
      this->Context.memory.endPlainPass(this->Levels.window().x().capacity());
    }
    this->StoppingRule.add(this->Levels.residualNorm(), this->Levels.roundingNorm(),
      this->Context.shareOfTolerance(this->StoppingRule.reference()),
      this->Context.scaledResidual());
    this->expect();
    if (this->Balance && this->Balance->add(this->Context.energy->value(),
                           this->StoppingRule.residuals().back(), this->StoppingRule.factor()))
    {
      this->StoppingRule.end();
    }
    this->Context.progress.endCycle(
      this->StoppingRule.cycles(), this->StoppingRule.residuals().back());
    this->Context.endPass(this->StoppingRule.residuals().back());
  }
  if (this->Accelerator.used() != std::string("none"))
  {
    this->Context.report.acceleration = this->Accelerator.used();
  }
  this->Accelerator.addNotes(this->Context.report.notes, this->NotePrefix);
  // Its memory is free for the results, or for the next problem.
  this->History.reset();
}

/**
 * Whether the next pass measures what later passes need, usually less than the first pass needed;
 * that decides whether acceleration fits. Only the first of the later passes does, since windows
 * grow with several chains; none does with a checkpoint, since a solve that continues has less
 * memory left over.
 */
bool Iteration::measuresMemory() const
{
  if (!this->Context.scratch || this->Context.checkpoint || this->Context.report.passes != 1)
  {
    return false;
  }
  const LevelWindow<double>& window = this->Levels.window();
  return this->Accelerator.isWanted() &&
         !this->Context.memory.hasRoom(window.nodes(), window.stride(), KeptResiduals::All);
}

/** Creates the history that the next V-cycle needs, or releases one that it does not need. */
void Iteration::addHistory()
{
  if (this->Accelerator.kind() != AccelerationKind::None && !this->History)
  {
    this->emplaceHistoryWithRoom();
  }
  if (this->Accelerator.kind() == AccelerationKind::None)
  {
    this->History.reset();
  }
}

/** Takes the best history that fits: residuals of all vertices or of a sample, as the mesh
 * needs; else the smallest sample; else the acceleration makes do with less. */
void Iteration::emplaceHistoryWithRoom()
{
  // The slowest errors may be local to a few vertices of slivers, too few of which are in a sample.
  // So it is on dragon.ply, where 0.7 % of the rows are stiff; with a tenth of that a sample
  // suffices.
  const KeptResiduals residuals = this->Accelerator.kind() != AccelerationKind::ConjugateGradients
                                    ? KeptResiduals::None
                                  : this->Levels.slowestAtSlivers() ? KeptResiduals::All
                                                                    : KeptResiduals::Sampled;
  const LevelWindow<double>& window = this->Levels.window();
  const std::optional<KeptResiduals> kept =
    this->Context.memory.residualsThatFit(window.nodes(), window.stride(), residuals);
  if (!kept)
  {
    this->Accelerator.saveMemory();
    return;
  }
  this->emplaceHistory(*kept);
  const bool areFewer = *kept != residuals;
  if (residuals != KeptResiduals::None && (areFewer || this->HasMeasured))
  {
    this->Accelerator.noteLimit(this->HasMeasured, areFewer);
  }
}

void Iteration::emplaceHistory(KeptResiduals residuals)
{
  LevelWindow<double>& window = this->Levels.window();
  this->ResidualStorage = residuals;
  this->History.emplace(this->Context.pool, window.nodes(), window.columns(), residuals);
  if (this->Context.scratch)
  {
    this->History->useScratch(*this->Context.scratch, this->Context.traffic.of("history", 0));
  }
}

void Iteration::expect()
{
  // A balance has a goal of its own, far above the least tolerance.
  if (!this->Balance)
  {
    this->Context.progress.expect(this->StoppingRule.goal());
  }
}

void Iteration::save(StateWriter& state)
{
  state.part("iteration");
  const bool accelerated = this->History.has_value();
  state(this->Accelerator, this->ResidualStorage, accelerated);
  if (accelerated)
  {
    state(*this->History);
  }
}

void Iteration::load(StateReader& state)
{
  state.part("iteration");
  bool accelerated = false;
  state(this->Accelerator, this->ResidualStorage, accelerated);
  if (accelerated)
  {
    this->emplaceHistory(this->ResidualStorage);
    state(*this->History);
  }
  this->expect();
  this->Context.progress.repeat(this->StoppingRule.residuals());
}

} // namespace smg
