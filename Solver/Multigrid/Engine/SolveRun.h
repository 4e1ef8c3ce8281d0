// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Assembly/Components.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/LongestFirst.h"
#include "Solver/Core/RunAll.h"
#include "Solver/Core/Timer.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/ScratchTraffic.h"
#include "Solver/Memory/MemoryLimitError.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Cycle/IterateEnergy.h"
#include "Solver/Multigrid/Cycle/LevelCursors.h"
#include "Solver/Multigrid/Engine/FreeComponents.h"
#include "Solver/Multigrid/Engine/SolveProgress.h"
#include "Solver/Multigrid/Engine/StepRecorder.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <tbb/task_arena.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace smg
{

/** The shared data of all parts of a solve and of its solution: options, memory, scratch files,
 * threads, the components of the mesh, progress and report. */
struct SMG_EXPORT SolveRun
{
  /** For problems of `columns` columns. */
  SolveRun(int columns, const SolveOptions& solveOptions);

  /** Starts the times of the report. */
  void beginReport();
  /** Since the start, with the programs from whose checkpoint this one continues. */
  double seconds() const { return this->SecondsBefore + this->Wall.seconds(); }
  /** Adds memory, scratch files and times to the report; `Report::levels` must be complete. */
  void finishReport();

  /** Performs the tasks of a step, concurrently, in the order for it: task(0) on the calling
   * thread. */
  template <class Task>
  void together(LongestFirst& order, Task&& task)
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
      order.sort(); // no task of one thread waits for another
    }
  }

  /** Whether the tasks of a step may run at once: then more of them are worth while. */
  bool isConcurrent() const { return this->scheduled > 1 || this->recorder; }

  /** How the parts of a solve save and restore what later passes need. */
  struct Parts
  {
    std::function<void(StateWriter&)> save;
    std::function<void(StateReader&)> load;
  };
  /**
   * To be called before the first pass: with a checkpoint, endPass() saves these parts, and a
   * solve of the same options and `subject` continues from its last state. Returns whether this
   * one does; then the first pass has been.
   */
  bool resume(std::vector<Checkpoint::Item> subject, Parts kept);
  /** After a pass that left this relative residual: reports it, and saves the state, with a
   * checkpoint. */
  void endPass(double residual);

  /** The error of a part that exceeded the limit, with the memory that suffices as a rule. */
  MemoryLimitError explained(const MemoryLimitError& error) const
  {
    return error.expecting(this->expectedBytes);
  }

  SolveOptions options;
  SolveProgress progress;
  Pool pool;
  /** Of the pool, on one thread, as estimated before the first pass; 0: unknown. */
  std::int64_t expectedBytes = 0;
  /** Whether the memory limit leaves room for many tasks in the first pass; see permitsTasks(). */
  bool isAmple = false;
  /** The most bytes of the pool in the first pass. */
  std::int64_t firstPassPeak = 0;
  /** The most bytes in a later pass without acceleration and in one chain; 0: not measured. */
  std::int64_t plainPassPeak = 0;
  /** The nodes of the finest level for whose values there was memory in that pass, or in the first.
   */
  std::int64_t valueNodes = 0;
  ResidentNodes resident;
  std::optional<ScratchFolder> scratch; ///< none in core
  std::optional<Checkpoint> checkpoint; ///< in the scratch folder
  ScratchTraffic traffic;
  Components components;
  ComponentLabels labels;
  FreeComponents free;
  std::optional<IterateEnergy> energy; ///< of the iterates, if the solve is to have it
  /** The number of threads that a pass is scheduled for; there may be fewer. */
  int scheduled;
  tbb::task_arena threads;
  StepRecorder* recorder = nullptr; ///< instead of the threads, if there is one
  Report report;

private:
  void save(StateWriter& state);
  void load(StateReader& state);

  Timer Wall;
  double CpuAtStart = 0.0;
  double SecondsBefore = 0.0;
  Parts Kept;
};

} // namespace smg
