// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Pass.h"

#include "Solver/Multigrid/Cycle/VCycle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace smg
{

void Pass::operator()(double scale, const Further& further)
try
{
  this->Levels.runCore();
  this->Levels.startPass(false);
  auto& finest = this->Levels.finest();
  const std::int64_t nodes = finest.window().nodes();
  finest.setHistory(further.history);
  finest.setScale(scaleFor(scale / std::sqrt(static_cast<double>(nodes))));

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
  schedule.trace().endStep();
  this->Run.note(schedule, false);
  this->Levels.noteWindows();
  this->Levels.endPass();
}
catch (const MemoryLimitError& error)
{
  throw this->Run.explained(error);
}

/** The stages of the pass, cut into chains, and what reads and writes beside them. A recorder
 * measures each stage, so it gets a chain of each. */
Schedule Pass::scheduleOf(const Further& further, int chains)
{
  auto& finest = this->Levels.finest();
  Schedule schedule(this->Run.trace());
  addUpward(finest, schedule);
  if (further.beforeDown)
  {
    schedule.add({ "begin the next problem", 0, static_cast<double>(this->Levels.window().nodes()),
                   further.beforeDown },
      [&finest] { return std::int64_t(finest.cursors().renewed); });
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
  finest.addWindows(schedule.trace());
  return schedule;
}

void Pass::begin()
{
  this->Levels.zeroCoarse();
  this->Levels.startPass(true);
  auto& finest = this->Levels.finest();
  finest.setScale(1.0);
  Schedule schedule(this->Run.trace());
  addDownward(finest, schedule);
  finest.addWindows(schedule.trace());
  schedule.advance();
  finest.settle();
  schedule.trace().endStep();
  this->Levels.endPass();
}

} // namespace smg
