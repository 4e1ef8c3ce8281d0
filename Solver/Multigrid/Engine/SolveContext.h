// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/Timer.h"
#include "Solver/Core/Workers.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Engine/FreeComponents.h"
#include "Solver/Multigrid/Engine/SolveProgress.h"
#include "Solver/Multigrid/Schedule/Schedule.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace smg
{

/** Performs the tasks of each step of a solve one after the other and keeps their processor
 * times. From these a model computes how long the steps take on any number of threads
 * (Testing/Benchmarks/ScheduleModel.h). */
class StepRecorder
{
public:
  struct Step
  {
    double before = 0.0;       ///< seconds since the step before this one, or the start of the pass
    std::vector<double> tasks; ///< seconds of each task
  };
  struct Pass
  {
    std::vector<double> costs; ///< of the stages, which come first among the tasks; see Schedule
    std::vector<Step> steps;
  };

  /** Starts a pass with stages of these costs; there are none in the first pass. */
  void startPass(std::vector<double> costs)
  {
    this->Passes.push_back({ std::move(costs), {} });
    this->Since = processSeconds();
  }

  /** Performs a step: task(0) .. task(count - 1). */
  template <class Task>
  void run(int count, Task&& task)
  {
    Step step{ this->lap(), {} };
    for (int k = 0; k < count; ++k)
    {
      task(k);
      step.tasks.push_back(this->lap());
    }
    this->Passes.back().steps.push_back(std::move(step));
  }

  const std::vector<Pass>& passes() const { return this->Passes; }

private:
  double lap()
  {
    const double now = processSeconds();
    return now - std::exchange(this->Since, now);
  }

  std::vector<Pass> Passes;
  double Since = 0.0;
};

/** What all parts of a solve, and its solution, share: options, memory, scratch files, threads,
 * the components of the mesh, progress and report. */
struct SMG_EXPORT SolveContext
{
  /** For problems of `columns` columns. */
  SolveContext(int columns, const SolveOptions& solveOptions);

  /** Starts the times of the report. */
  void beginReport();
  /** Seconds since the start, including those of the programs from whose checkpoint this one
   * continues. */
  double seconds() const { return this->SecondsBefore + this->Wall.seconds(); }
  /** Adds memory, scratch files and times to the report; `Report::levels` must be complete. */
  void finishReport();

  /** Adds the times of a schedule's stages to the report. */
  void note(const Schedule& schedule, bool isFirstPass);

  /** Performs the tasks of a step on the threads, in this order; task(0) on the calling thread.
   * With a recorder, one after the other. */
  template <class Task>
  void runConcurrently(LongestTaskFirst& order, Task&& task)
  {
    if (this->recorder)
    {
      this->recorder->run(order.tasks(), task);
      return;
    }
    runAll(this->threads, order.tasks(),
      [&](int place)
      {
        const int number = order[place];
        const Timer timer;
        task(number);
        order.add(number, timer.seconds());
      });
    if (this->scheduled > 1)
    {
      order.sort(); // on one thread the order does not matter
    }
  }

  /** Whether the tasks of a step may run at the same time: then it is worth while to have more
   * of them. */
  bool isConcurrent() const { return this->scheduled > 1 || this->recorder; }

  /** How the parts of a solve save and restore what later passes need. */
  struct Parts
  {
    std::function<void(StateWriter&)> save;
    std::function<void(StateReader&)> load;
  };
  /** To be called before the first pass. With a checkpoint, endPass() saves these parts, and a
   * solve with the same options and `subject` continues from the last saved state. Returns
   * whether this one does; then there is no first pass. */
  bool resume(std::vector<Checkpoint::Item> subject, Parts kept);
  /** To be called after a pass that left this relative residual: reports it and, with a
   * checkpoint, saves the state. */
  void endPass(double residual);

  /** The error of a part that exceeded the limit, completed by the memory that usually suffices. */
  MemoryLimitError explained(const MemoryLimitError& error) const
  {
    return error.expecting(this->expectedBytes);
  }

  SolveOptions options;
  SolveProgress progress;
  Pool pool;
  /** The bytes of the pool that one thread is expected to need, estimated before the first pass;
   * 0: unknown. */
  std::int64_t expectedBytes = 0;
  /** Whether the memory limit leaves room for many tasks in the first pass; see permitsTasks(). */
  bool isAmple = false;
  /** The peak of the pool in the first pass, in bytes. */
  std::int64_t firstPassPeak = 0;
  /** The peak in a later pass without acceleration and in one chain; 0: not measured. */
  std::int64_t plainPassPeak = 0;
  /** The number of nodes of the finest level for whose values that pass, or else the first one,
   * had memory. */
  std::int64_t valueNodes = 0;
  ResidentNodes resident;
  std::optional<ScratchFolder> scratch; ///< none in core
  std::optional<Checkpoint> checkpoint; ///< in the scratch folder
  ScratchTraffic traffic;
  Components components;
  ComponentLabels labels;
  FreeComponents free;
  std::optional<IterateEnergy> energy; ///< energy of the iterates, if the solve needs it
  /** The number of threads that a pass is scheduled for. The machine may have fewer. */
  int scheduled;
  Workers threads;
  StepRecorder* recorder = nullptr; ///< takes the place of the threads, if there is one
  Report report;

private:
  void save(StateWriter& state);
  void load(StateReader& state);

  Timer Wall;
  double CpuAtStart = 0.0;
  double SecondsBefore = 0.0;
  Parts Kept;
};

/** The part of a report that the passes of a solve set, for StateWriter and StateReader. The end
 * of the solve sets the rest. */
template <class State>
struct ReportState
{
  Report& report;

  void exchange(State& state)
  {
    Report& r = this->report;
    state.part("report");
    state(r.vertices, r.cells, r.levels, r.passes, r.cycles, r.residuals, r.acceleration);
    this->exchangeSteps(state);
    this->exchangePasses(state);
    state(r.converged, r.seconds, r.cpu_seconds, r.rss_bytes_peak, r.prescribed, r.shared, r.held,
      r.degenerate_cells, r.coincident_cells, r.clamped_weights, r.components, r.free_components,
      r.removed_source, r.notes, r.warnings);
  }

private:
  void exchangePasses(State& state)
  {
    auto passes = static_cast<std::uint64_t>(this->report.by_pass.size());
    state(passes);
    this->report.by_pass.resize(passes);
    for (Report::Pass& pass : this->report.by_pass)
    {
      state(pass.residual, pass.seconds, pass.read, pass.written, pass.pool_bytes);
    }
  }

  void exchangeSteps(State& state)
  {
    auto steps = static_cast<std::uint8_t>(this->report.steps.size());
    state(steps);
    this->report.steps.resize(steps);
    for (Report::Step& step : this->report.steps)
    {
      state(step.name, step.cycles, step.residual, step.converged);
    }
  }
};

} // namespace smg
