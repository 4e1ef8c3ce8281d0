// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "Solver/Cycle/LevelCursors.h"
#include "Solver/Engine/FreeComponents.h"
#include "Solver/Engine/SolveProgress.h"
#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Problem/Components.h"
#include "Solver/Storage/Pool.h"
#include "Solver/Storage/ScratchFolder.h"
#include "Solver/Storage/ScratchTraffic.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <tbb/task_arena.h>

#include <optional>

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
  /** Adds memory, scratch files and times to the report; `Report::levels` must be complete. */
  void finishReport();

  SolveOptions options;
  SolveProgress progress;
  Pool pool;
  ResidentNodes resident;
  std::optional<ScratchFolder> scratch; ///< none in core
  ScratchTraffic traffic;
  Components components;
  ComponentLabels labels;
  FreeComponents free;
  tbb::task_arena threads;
  Report report;

private:
  Timer Wall;
  double CpuAtStart = 0.0;
};

} // namespace smg
