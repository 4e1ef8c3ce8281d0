// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/Acceleration.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/ErrorBalance.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/Pass.h"
#include "Solver/Multigrid/Engine/SolveContext.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace smg
{

/**
 * The V-cycles of a problem after the first pass, one per pass, accelerated where that pays off.
 *
 * Whether acceleration has room depends on the memory limit and on what earlier passes needed,
 * never on the number of threads: the solution depends on it. Where a bound of the need exceeds the
 * limit, the first of these passes is not accelerated, has one chain of stages, and measures what
 * passes need; then as much is kept as fits (KeptResiduals).
 */
template <class Relaxation>
class Iteration
{
public:
  /** Notes begin with `what`. If `balance` is not null, it may end the V-cycles, too. */
  Iteration(SolveContext& run, Hierarchy<Relaxation>& hierarchy, Convergence& convergence,
    std::string what = "", ErrorBalance* balance = nullptr)
    : Run(run)
    , Levels(hierarchy)
    , Watched(convergence)
    , What(std::move(what))
    , Balance(balance)
    , Faster(run.options.acceleration, convergence)
  {
  }

  /** Performs V-cycles until convergence or, with `spareLast`, until only the last permitted one
   * is left, which shares its pass with the next problem. */
  void operator()(bool spareLast);

  /** Between passes: saves and restores all that later passes need, except the hierarchy and the
   * convergence. */
  void save(StateWriter& state);
  void load(StateReader& state);

private:
  void addHistory();
  void emplaceHistoryWithRoom();
  bool measuresMemory() const;
  bool hasRoom(KeptResiduals residuals) const;
  void emplaceHistory(KeptResiduals residuals);

  SolveContext& Run;
  Hierarchy<Relaxation>& Levels;
  Convergence& Watched;
  std::string What;
  ErrorBalance* Balance;
  Acceleration Faster;
  KeptResiduals Kept = KeptResiduals::None; // by the history, for a checkpoint
  std::optional<IterateHistory> History;
};

template <class Relaxation>
void Iteration<Relaxation>::operator()(bool spareLast)
{
  Pass<Relaxation> pass(this->Run, this->Levels);
  while (!this->Watched.done() && !(spareLast && this->Watched.isLast()))
  {
    const bool measures = this->measuresMemory();
    if (!measures)
    {
      this->Faster.decide();
      this->addHistory();
    }
    if (this->History)
    {
      this->History->startPass(this->Faster.next(this->History->products()));
    }
    // The peak of this pass alone, should it be the one that measures.
    this->Run.pool.restartPeak();
    pass(this->Watched.norm(), { {}, {}, this->History ? &*this->History : nullptr, measures });
    if (measures)
    {
      this->Run.plainPassPeak = this->Run.pool.recentPeak();
      this->Run.valueNodes = this->Levels.window().x().capacity();
    }
    this->Watched.add(this->Levels.residualNorm(), this->Levels.roundingNorm());
    if (this->Balance && this->Balance->add(this->Run.energy->value(),
                           this->Watched.residuals().back(), this->Watched.factor()))
    {
      this->Watched.end();
    }
    this->Run.progress.endCycle(this->Watched.cycles(), this->Watched.residuals().back());
    this->Run.endPass(this->Watched.residuals().back());
  }
  if (this->Faster.used() != std::string("none"))
  {
    this->Run.report.acceleration = this->Faster.used();
  }
  this->Faster.addNotes(this->Run.report.notes, this->What);
  // Its memory is free for the results, or for the next problem.
  this->History.reset();
}

/**
 * Whether the next pass measures what later passes need, usually less than the first pass needed;
 * that decides whether acceleration fits. Only the first of the later passes does, since windows
 * grow with several chains; none does with a checkpoint, since a solve that continues has less
 * memory left over.
 */
template <class Relaxation>
bool Iteration<Relaxation>::measuresMemory() const
{
  if (!this->Run.scratch || this->Run.checkpoint || this->Run.report.passes != 1)
  {
    return false;
  }
  return this->Faster.isWanted() && !this->hasRoom(KeptResiduals::All);
}

/** Creates the history that the next V-cycle needs, or releases one that it does not need. */
template <class Relaxation>
void Iteration<Relaxation>::addHistory()
{
  if (this->Faster.kind() != AccelerationKind::None && !this->History)
  {
    this->emplaceHistoryWithRoom();
  }
  if (this->Faster.kind() == AccelerationKind::None)
  {
    this->History.reset();
  }
}

/** Takes the best history that fits: residuals of all vertices or of a sample, as the mesh
 * needs; else the smallest sample; else the acceleration makes do with less. */
template <class Relaxation>
void Iteration<Relaxation>::emplaceHistoryWithRoom()
{
  // The slowest errors may be local to a few vertices of slivers, too few of which are in a sample.
  // So it is on dragon.ply, where 0.7 % of the rows are stiff; with a tenth of that a sample
  // suffices.
  const KeptResiduals residuals = this->Faster.kind() != AccelerationKind::ConjugateGradients
                                    ? KeptResiduals::None
                                  : this->Levels.slowestAtSlivers() ? KeptResiduals::All
                                                                    : KeptResiduals::Sampled;
  if (this->hasRoom(residuals))
  {
    this->emplaceHistory(residuals);
  }
  else if (residuals != KeptResiduals::None && this->hasRoom(KeptResiduals::Few))
  {
    this->emplaceHistory(KeptResiduals::Few);
  }
  else
  {
    this->Faster.saveMemory();
  }
}

/** Whether the memory limit has room for a history with these residuals. The number of threads
 * must not matter, since the solution depends on the answer. */
template <class Relaxation>
bool Iteration<Relaxation>::hasRoom(KeptResiduals residuals) const
{
  constexpr std::int64_t Pages = std::int64_t(1) << 16; // rings grow by pages, and ahead of need
  const Pool& pool = this->Run.pool;
  const LevelWindow<double>& window = this->Levels.window();
  const std::int64_t nodes = window.nodes();
  if (!this->Run.scratch)
  {
    const std::int64_t need = nodes * IterateHistory::nodeBytes(window.stride(), residuals);
    return pool.used() + need + need / 4 + Pages <= pool.limit();
  }
  if (this->Run.isAmple && this->Run.expectedBytes > 0)
  {
    return true; // the limit is far above the need: permitsTasks()
  }
  return this->Run.passBytes(window.stride(), IterateHistory::sparseness(nodes, residuals)) <=
         pool.limit();
}

template <class Relaxation>
void Iteration<Relaxation>::emplaceHistory(KeptResiduals residuals)
{
  LevelWindow<double>& window = this->Levels.window();
  this->Kept = residuals;
  this->History.emplace(this->Run.pool, window.nodes(), window.columns(), residuals);
  if (this->Run.scratch)
  {
    this->History->useScratch(*this->Run.scratch, this->Run.traffic.add("history", 0));
  }
}

template <class Relaxation>
void Iteration<Relaxation>::save(StateWriter& state)
{
  state.part("iteration");
  const bool accelerated = this->History.has_value();
  state(this->Faster, this->Kept, accelerated);
  if (accelerated)
  {
    state(*this->History);
  }
}

template <class Relaxation>
void Iteration<Relaxation>::load(StateReader& state)
{
  state.part("iteration");
  bool accelerated = false;
  state(this->Faster, this->Kept, accelerated);
  if (accelerated)
  {
    this->emplaceHistory(this->Kept);
    state(*this->History);
  }
  this->Run.progress.repeat(this->Watched.residuals());
}

} // namespace smg
