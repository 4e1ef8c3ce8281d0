// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Pass.h"

#include "Solver/Multigrid/Cycle/VCycle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace smg
{

void Pass::run(double scale, const Options& options)
try
{
  this->Levels.runCore();
  this->Levels.startPass(false);
  auto& finest = this->Levels.finest();
  const std::int64_t nodes = finest.window().nodes();
  finest.setHistory(options.history);
  finest.setScale(scaleFor(scale / std::sqrt(static_cast<double>(nodes))));

  const MemoryPlan::Steps steps =
    options.inOneChain
      ? this->Context.memory.leastSteps()
      : this->Context.memory.stepsOf(nodes, finest.window().stride(),
          options.history ? std::optional(options.history->sparseness()) : std::nullopt,
          this->Context.threads.scheduled);
  Schedule schedule = this->scheduleOf(options, steps.chains);
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
    if (options.next)
    {
      options.next->load();
    }
    // The cursors at the beginning of the step: also the tasks that write nodes use them.
    finest.publish();
    return true;
  };
  const auto settle = [&]
  {
    finest.release();
    this->Context.progress.update(static_cast<double>(end - 1) / static_cast<double>(nodes));
  };
  schedule.perform(this->Context.threads, prepare, settle);
  // All is loaded now. The upward part runs to its end; the downward part, which relies on
  // published cursors, follows in a second round.
  schedule.advance();
  finest.publish();
  schedule.advance();
  finest.settle();
  schedule.trace().endStep();
  this->Context.note(schedule, false);
  this->Levels.noteWindows();
  this->Levels.endPass();
}
catch (const MemoryLimitError& error)
{
  throw this->Context.explained(error);
}

/** The stages of the pass, cut into chains, and what reads and writes beside them. A recorder
 * measures each stage, so it gets a chain of each. */
Schedule Pass::scheduleOf(const Options& options, int chains)
{
  auto& finest = this->Levels.finest();
  Schedule schedule(this->Context.trace());
  addUpward(finest, schedule);
  if (NextSystem* next = options.next)
  {
    schedule.add({ "begin the next system", 0, static_cast<double>(this->Levels.window().nodes()),
                   [next, &finest](bool follows)
                   { finest.setRenewed(next->fill(finest.finishedUp(next->taken(), follows))); } },
      [&finest] { return std::int64_t(finest.cursors().renewed); });
  }
  addDownward(finest, schedule);
  if (StepRecorder* recorder = this->Context.threads.recorder)
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
  finest.addWindows(schedule.trace());
  return schedule;
}

void Pass::begin()
{
  this->Levels.zeroCoarse();
  this->Levels.startPass(true);
  auto& finest = this->Levels.finest();
  finest.setScale(1.0);
  Schedule schedule(this->Context.trace());
  addDownward(finest, schedule);
  finest.addWindows(schedule.trace());
  schedule.advance();
  finest.settle();
  schedule.trace().endStep();
  this->Levels.endPass();
}

} // namespace smg
