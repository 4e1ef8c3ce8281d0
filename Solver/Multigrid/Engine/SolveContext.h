// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/Timer.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Cycle/IterateFlow.h"
#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Engine/ColumnScales.h"
#include "Solver/Multigrid/Engine/FreeComponents.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "Solver/Multigrid/Engine/SolveProgress.h"
#include "Solver/Multigrid/Schedule/Schedule.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** What all parts of a solve, and its solution, share: options, memory, scratch files, threads,
 * the components of the mesh, progress and report. */
struct SMG_EXPORT SolveContext
{
  /** For problems of `columns` columns. */
  SolveContext(int columns, const SolveOptions& solveOptions);

  /** Starts the times of the report. */
  void beginReport();
  /** So far the report describes the mesh and the hierarchy only: keeps it for later solves. */
  void keepReport() { this->BuildReport = this->report; }
  /** Starts the report of a further solve on the same hierarchy. */
  void beginAgain();
  /** Seconds since the start, including those of the programs from whose checkpoint this one
   * continues. */
  double seconds() const { return this->SecondsBefore + this->Wall.seconds(); }
  /** Adds memory, scratch files and times to the report; `Report::levels` must be complete. */
  void finishReport();

  /** Of the pass that begins. */
  StepTrace trace() const { return { this->options.trace, this->report.passes + 1 }; }
  /** Adds the times of a schedule's stages to the report. */
  void note(const Schedule& schedule, bool isFirstPass);
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
    const MemoryLimitError expecting = error.expecting(this->memory.expected());
    return this->couplings ? expecting.of(CoupledSolveMemory) : expecting;
  }

  /** Reads the values of vertices [first, first + count) from the window of the finest level, and
   * adds what the equations leave open: means of free components, undetermined values, and the
   * values of vertices that are tied to others. */
  void readCompleted(
    LevelWindow<double>& window, std::int64_t first, std::int64_t count, std::span<double> values);

  /** The norm of what flows, where `flow` measures it, with the scales of columns. */
  double flowNorm() const;
  /** The part of the tolerance by which a residual of the last pass is judged, `reference` being
   * the residual that the tolerance is a share of: less than 1 where little flows beside that. 1 if
   * the solve does not need it. */
  double shareOfTolerance(double reference) const;
  /** The residual of the last pass in rows that are all alike: see IterateFlow. 0 if the solve does
   * not need it. */
  double scaledResidual() const { return this->flow ? this->flow->scaledResidual() : 0.0; }

  SolveOptions options;
  /** The solution whose correction is solved for; null: the problem itself. */
  Solution* corrected = nullptr;
  SolveProgress progress;
  Pool pool;
  MemoryPlan memory;
  ResidentNodes resident;
  std::optional<ScratchFolder> scratch; ///< none in core
  std::optional<Checkpoint> checkpoint; ///< in the scratch folder
  ScratchTraffic traffic;
  Components components;
  ComponentLabels labels;
  FreeComponents free;
  std::shared_ptr<const VertexCouplings> couplings; ///< of the problem; null: none
  std::optional<IterateEnergy> energy; ///< energy of the iterates, if the solve needs it
  std::optional<IterateFlow> flow;     ///< in the iterates, if the solve needs it
  bool mayMeasureFlow = false;         ///< in later passes, if coefficients differ much
  ColumnScales scales;                 ///< of the columns in the norms of residuals
  StepThreads threads;
  Report report;

private:
  void save(StateWriter& state);
  void load(StateReader& state);

  Timer Wall;
  double CpuAtStart = 0.0;
  double SecondsBefore = 0.0;
  Parts Kept;
  Report BuildReport;
};

} // namespace smg
