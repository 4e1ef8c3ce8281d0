// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Acceleration.h"
#include "Solver/Engine/Convergence.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/Pass.h"
#include "Solver/Engine/SolveRun.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace smg
{

/**
 * The V-cycles of a problem after the first pass, one per pass, accelerated where that pays off.
 */
template <class Relaxation>
class Iteration
{
public:
  /** Notes begin with `what`. */
  Iteration(SolveRun& run, Hierarchy<Relaxation>& hierarchy, Convergence& convergence,
    std::string what = "")
    : Run(run)
    , Levels(hierarchy)
    , Watched(convergence)
    , What(std::move(what))
    , Faster(run.options.acceleration, convergence)
  {
  }

  /** Performs V-cycles until convergence or, with `spareLast`, until only the last allowed one is
   * left. */
  void operator()(bool spareLast);

private:
  void addHistory();

  SolveRun& Run;
  Hierarchy<Relaxation>& Levels;
  Convergence& Watched;
  std::string What;
  Acceleration Faster;
  std::optional<IterateHistory> History;
};

template <class Relaxation>
void Iteration<Relaxation>::operator()(bool spareLast)
{
  Pass<Relaxation> pass(this->Run, this->Levels);
  while (!this->Watched.done() && !(spareLast && this->Watched.isLast()))
  {
    this->Faster.decide();
    this->addHistory();
    if (this->History)
    {
      this->History->startPass(this->Faster.next(this->History->products()));
    }
    pass(this->Watched.norm(), { {}, {}, this->History ? &*this->History : nullptr });
    this->Watched.add(this->Levels.residualNorm(), this->Levels.roundingNorm());
    this->Run.progress.endCycle(this->Watched.cycles(), this->Watched.residuals().back());
  }
  if (this->Faster.used() != std::string("none"))
  {
    this->Run.report.acceleration = this->Faster.used();
  }
  this->Faster.addNotes(this->Run.report.notes, this->What);
}

/** Creates the history that the next V-cycle needs, or releases one that it does not need. */
template <class Relaxation>
void Iteration<Relaxation>::addHistory()
{
  if (this->Faster.kind() != AccelerationKind::None && !this->History)
  {
    LevelWindow<double>& window = this->Levels.window();
    // The slowest errors may be local to some vertices of slivers, too few of which are in a
    // sample: so on dragon.ply, where 0.7 % of the rows are stiff; with a tenth of that a sample is
    // sufficient.
    const KeptResiduals residuals = this->Faster.kind() != AccelerationKind::ConjugateGradients
                                      ? KeptResiduals::None
                                    : this->Levels.slowestAtSlivers() ? KeptResiduals::All
                                                                      : KeptResiduals::Sampled;
    const std::int64_t nodes =
      this->Run.scratch ? std::min(window.nodes(), this->Run.resident.peak) : window.nodes();
    const std::int64_t need = nodes * IterateHistory::nodeBytes(window.stride(), residuals);
    constexpr std::int64_t Pages = std::int64_t(1) << 16; // memory grows by pages, and ahead
    Pool& pool = this->Run.pool;
    if (pool.used() + need + need / 4 + Pages <= pool.limit())
    {
      this->History.emplace(pool, window.nodes(), window.columns(), residuals);
      if (this->Run.scratch)
      {
        this->History->useScratch(this->Run.scratch->path(), this->Run.traffic.add("history", 0));
      }
      return;
    }
    this->Faster.giveUp("it would need more than the memory limit");
  }
  if (this->Faster.kind() == AccelerationKind::None)
  {
    this->History.reset();
  }
}

} // namespace smg
