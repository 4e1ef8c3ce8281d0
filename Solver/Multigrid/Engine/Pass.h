// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace smg
{

/**
 * The bytes of the pool that a pass out of core needs in one chain, with a history of this
 * sparseness (0: steps alone) or without one, for `stride` values per node: bounds of what
 * surfaces, solids and scans of 50 thousand to 2.8 million vertices needed. Most passes need less
 * than the first one, down to a third of it; on slivers they need up to 1.1 times as much.
 */
inline std::int64_t passBytes(
  const SolveContext& run, int stride, std::optional<std::int64_t> sparseness)
{
  std::int64_t bytes = run.plainPassPeak > 0 ? run.plainPassPeak + run.plainPassPeak / 10
                                             : run.firstPassPeak + run.firstPassPeak / 8;
  if (sparseness)
  {
    // In the window, and in blocks that are prefetched or wait to be written.
    const std::int64_t nodes = run.valueNodes + 6 * RowBlock::Nodes;
    const std::int64_t values = nodes * stride * std::int64_t(sizeof(double));
    bytes += values * 5 / 4 + (*sparseness > 0 ? values * 7 / 4 / *sparseness : 0);
  }
  return bytes;
}

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
  void stream(const Further& further);
  Schedule scheduleOf(const Further& further, int chains);
  struct Grain
  {
    std::int64_t step; ///< nodes of the finest level in a step
    int chains;
  };
  Grain grain(const Further& further) const;
  std::int64_t chainsFor(std::int64_t step, const IterateHistory* history) const;

  SolveContext& Run;
  Hierarchy<Relaxation>& Levels;
};

template <class Relaxation>
void Pass<Relaxation>::operator()(double scale, const Further& further)
{
  try
  {
    this->Levels.runCore();
    this->Levels.startPass(false);
    this->Levels.finest().setHistory(further.history);
    this->setScale(scale / std::sqrt(static_cast<double>(this->Levels.window().nodes())));
    this->stream(further);
  }
  catch (const MemoryLimitError& error)
  {
    throw this->Run.explained(error);
  }
  this->Levels.endPass();
}

/** Lets restriction scale numbers of this size to about 1: by a power of two, so that nothing is
 * rounded, and by 1 if the size is not a usable number. */
template <class Relaxation>
void Pass<Relaxation>::setScale(double typical)
{
  this->Levels.finest().setScale(
    typical > DBL_MIN && typical < DBL_MAX ? std::exp2(-std::ilogb(typical)) : 1.0);
}

template <class Relaxation>
void Pass<Relaxation>::stream(const Further& further)
{
  auto& finest = this->Levels.finest();
  const Grain grain = this->grain(further);
  Schedule schedule = this->scheduleOf(further, grain.chains);
  const std::int64_t nodes = finest.window().nodes();
  std::int64_t end = 0;
  schedule.perform(
    this->Run,
    [&]
    {
      if (end == nodes)
      {
        return false;
      }
      end = std::min(nodes, end + grain.step);
      // Rings grow here only, when no task runs.
      finest.load(end - 1);
      if (further.loaded)
      {
        further.loaded();
      }
      // The cursors at the beginning of the step: also the tasks that write nodes use them.
      finest.publish();
      return true;
    },
    [&]
    {
      finest.release();
      this->Run.progress.update(static_cast<double>(end - 1) / static_cast<double>(nodes));
    });
  // All is loaded now. The upward part runs to its end; the downward part, which relies on
  // published cursors, follows in a second round.
  schedule.advance();
  finest.publish();
  schedule.advance();
  finest.settle();
  this->Run.note(schedule, false);
  this->Levels.noteWindows();
}

/** The stages of the pass, cut into chains, and what reads and writes beside them. A recorder
 * measures each stage, so it gets a chain of each. */
template <class Relaxation>
Schedule Pass<Relaxation>::scheduleOf(const Further& further, int chains)
{
  auto& finest = this->Levels.finest();
  Schedule schedule;
  finest.addUpward(schedule);
  if (further.beforeDown)
  {
    schedule.add({ "begin the next problem", 0, static_cast<double>(this->Levels.window().nodes()),
      further.beforeDown });
  }
  finest.addDownward(schedule);
  if (StepRecorder* recorder = this->Run.recorder)
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

/** The length of the steps and the number of chains for the threads, as far as the memory
 * suffices. Shorter steps are preferred to fewer chains. */
template <class Relaxation>
auto Pass<Relaxation>::grain(const Further& further) const -> Grain
{
  const std::int64_t usual = this->Run.options.blockNodes;
  if (further.inOneChain)
  {
    return { usual, 1 };
  }
  const std::int64_t wanted = Schedule::chainsFor(this->Run.scheduled);
  const std::int64_t longer = Schedule::stepFor(this->Run.scheduled, usual);
  const std::int64_t step = this->chainsFor(longer, further.history) < wanted ? usual : longer;
  const std::int64_t chains = this->chainsFor(step, further.history);
  return { step, static_cast<int>(std::clamp(chains, std::int64_t(1), wanted)) };
}

/** The number of chains for which the memory suffices: each keeps the nodes of a step in memory.
 * In core all nodes are in memory anyway. */
template <class Relaxation>
std::int64_t Pass<Relaxation>::chainsFor(std::int64_t step, const IterateHistory* history) const
{
  constexpr std::int64_t NodeBytes = 400; // measured, with coarser levels: 220 of surfaces
  if (!this->Run.scratch)
  {
    return std::numeric_limits<std::int64_t>::max();
  }
  const std::optional<std::int64_t> sparseness =
    history ? std::optional(history->sparseness()) : std::nullopt;
  // At least a bit more than the first pass needed, since a pass that two problems share has the
  // values of both.
  const std::int64_t first = this->Run.firstPassPeak;
  const std::int64_t need =
    std::max(first + first / 16, passBytes(this->Run, this->Levels.window().stride(), sparseness));
  const std::int64_t room = this->Run.pool.limit() - need;
  return room / (NodeBytes * std::min(step, this->Levels.window().nodes()));
}

template <class Relaxation>
void Pass<Relaxation>::begin()
{
  this->Levels.zeroCoarse();
  this->Levels.startPass(true);
  auto& finest = this->Levels.finest();
  finest.setScale(1.0);
  finest.advanceDown();
  finest.settle();
  this->Levels.endPass();
}

} // namespace smg
