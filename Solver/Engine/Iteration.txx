// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Engine.h"

#include <algorithm>
#include <string>

namespace smg
{

template <OperatorSet Operators>
void Engine<Operators>::iterate(Convergence& convergence, bool spareLast, const std::string& what)
{
  Acceleration acceleration(this->Options.acceleration, convergence);
  std::optional<IterateHistory> history;
  while (!convergence.done() && !(spareLast && convergence.isLast()))
  {
    acceleration.decide();
    this->addHistory(acceleration, history);
    if (history)
    {
      history->startPass(acceleration.next(history->products()));
    }
    this->runCore();
    this->pass(
      convergence.norm(), [] {}, [] {}, history ? &*history : nullptr);
    convergence.add(this->residualNorm(), this->roundingNorm());
    this->Progress.endCycle(convergence.cycles(), convergence.residuals().back());
  }
  if (acceleration.used() != std::string("none"))
  {
    this->Result.acceleration = acceleration.used();
  }
  acceleration.addNotes(this->Result.notes, what);
}

/** Makes the history that the next V-cycle needs, or lets go of one that it does not need. */
template <OperatorSet Operators>
void Engine<Operators>::addHistory(
  Acceleration& acceleration, std::optional<IterateHistory>& history)
{
  LevelWindow<double>& window = this->Hierarchy.finest->window();
  const KeptResiduals residuals = acceleration.kind() != AccelerationKind::ConjugateGradients
                                    ? KeptResiduals::None
                                  : this->SlowestAreAtSlivers ? KeptResiduals::All
                                                              : KeptResiduals::Sampled;
  if (acceleration.kind() != AccelerationKind::None && !history)
  {
    const std::int64_t nodes =
      this->Scratch ? std::min(window.nodes(), this->Resident.peak) : window.nodes();
    const std::int64_t need = nodes * IterateHistory::nodeBytes(window.stride(), residuals);
    constexpr std::int64_t Pages = std::int64_t(1) << 16; // memory grows by pages, and ahead
    if (this->Memory.used() + need + need / 4 + Pages <= this->Memory.limit())
    {
      history.emplace(this->Memory, window.nodes(), window.columns(), residuals);
      if (this->Scratch)
      {
        history->useScratch(this->Scratch->path(), this->Traffic.add("history", 0));
      }
      return;
    }
    acceleration.giveUp("it would need more than the memory limit");
  }
  if (acceleration.kind() == AccelerationKind::None)
  {
    history.reset();
  }
}

} // namespace smg
