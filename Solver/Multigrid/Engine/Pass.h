// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

namespace smg
{

/**
 * A pass over the levels, which finishes a V-cycle and begins the next one. k V-cycles take k + 1
 * passes with the first one, as in the paper.
 *
 * The pass moves over the finest level in steps. In each step load() makes available what the
 * upward part needs up to the end of the step, the chains of stages and the files advance as tasks
 * that may run at the same time, and release() returns what all stages have passed. Chains see the
 * cursors that the others had at the beginning of the step.
 */
template <class Relaxation>
class Pass
{
public:
  /** Optional further actions of a pass. */
  struct Further
  {
    /** Called in each step after the finest level was loaded. */
    std::function<void()> loaded;
    /** A further stage between the upward and the downward part of the finest level. */
    std::function<void(bool follows)> beforeDown;
    /** The history of the iterates, if the pass is accelerated. */
    IterateHistory* history = nullptr;
    /** Whether the pass has one chain of stages, which takes the least memory. */
    bool inOneChain = false;
  };

  Pass(SolveContext& run, Hierarchy<Relaxation>& hierarchy)
    : Run(run)
    , Levels(hierarchy)
  {
  }

  /** Performs the part of the V-cycle on the core levels, then a pass; `scale` is the
   * approximate size of the residuals in it. */
  void operator()(double scale, const Further& further = {});

  /** In core: begins the first V-cycle of a problem whose right-hand side and initial values are
   * in the window of the finest level. */
  void begin();

private:
  void setScale(double typical);
  Schedule scheduleOf(const Further& further, int chains);

  SolveContext& Run;
  Hierarchy<Relaxation>& Levels;
};

template <class Relaxation>
void Pass<Relaxation>::operator()(double scale, const Further& further)
try
{
  this->Levels.runCore();
  this->Levels.startPass(false);
  auto& finest = this->Levels.finest();
  const std::int64_t nodes = finest.window().nodes();
  finest.setHistory(further.history);
  this->setScale(scale / std::sqrt(static_cast<double>(nodes)));

  const SolveContext::Steps steps =
    further.inOneChain
      ? SolveContext::Steps{ this->Run.options.blockNodes, 1 }
      : this->Run.stepsOf(nodes, finest.window().stride(),
          further.history ? std::optional(further.history->sparseness()) : std::nullopt);
  Schedule schedule = this->scheduleOf(further, steps.chains);
  std::int64_t end = 0;
  const auto prepare = [&]
  {
    if (end == nodes)
    {
      return false;
    }
    end = std::min(nodes, end + steps.nodes);
    // Rings grow here only, when no task runs.
    finest.load(end - 1);
    if (further.loaded)
    {
      further.loaded();
    }
    // The cursors at the beginning of the step: also the tasks that write nodes use them.
    finest.publish();
    return true;
  };
  const auto settle = [&]
  {
    finest.release();
    this->Run.progress.update(static_cast<double>(end - 1) / static_cast<double>(nodes));
  };
  schedule.perform(this->Run.threads, prepare, settle);
  // All is loaded now. The upward part runs to its end; the downward part, which relies on
  // published cursors, follows in a second round.
  schedule.advance();
  finest.publish();
  schedule.advance();
  finest.settle();
  this->Run.note(schedule, false);
  this->Levels.noteWindows();
  this->Levels.endPass();
}
catch (const MemoryLimitError& error)
{
  throw this->Run.explained(error);
}

/** Lets restriction scale numbers of this size to about 1: by a power of two, so that nothing is
 * rounded, and by 1 if the size is not a usable number. */
template <class Relaxation>
void Pass<Relaxation>::setScale(double typical)
{
  this->Levels.finest().setScale(
    typical > DBL_MIN && typical < DBL_MAX ? std::exp2(-std::ilogb(typical)) : 1.0);
}

/** The stages of the pass, cut into chains, and what reads and writes beside them. A recorder
 * measures each stage, so it gets a chain of each. */
template <class Relaxation>
Schedule Pass<Relaxation>::scheduleOf(const Further& further, int chains)
{
  auto& finest = this->Levels.finest();
  Schedule schedule;
  addUpward(finest, schedule);
  if (further.beforeDown)
  {
    schedule.add({ "begin the next problem", 0, static_cast<double>(this->Levels.window().nodes()),
      further.beforeDown });
  }
  addDownward(finest, schedule);
  if (StepRecorder* recorder = this->Run.threads.recorder)
  {
    recorder->startPass(schedule.costs());
    schedule.cutAll();
  }
  else
  {
    schedule.cut(chains);
  }
  finest.addReaders(schedule);
  finest.addWriters(schedule);
  return schedule;
}

template <class Relaxation>
void Pass<Relaxation>::begin()
{
  this->Levels.zeroCoarse();
  this->Levels.startPass(true);
  auto& finest = this->Levels.finest();
  finest.setScale(1.0);
  Schedule schedule;
  addDownward(finest, schedule);
  schedule.advance();
  finest.settle();
  this->Levels.endPass();
}

} // namespace smg
