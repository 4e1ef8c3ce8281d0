// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Core/Timer.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/Problem.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace smg
{

/** What the parts of a job share with its result: options, memory, scratch files, and the report.
 * A job reads the mesh and solves; the solves have what it leaves of its limits. */
struct JobRun
{
  explicit JobRun(const SolveOptions& jobOptions, const PoolUse& use = SolveMemory);

  /** Reads a mesh once with visit(block), and counts the pass. Throws Cancelled. */
  template <class Visit>
  void read(MeshSource& mesh, ProgressPart part, const Visit& visit)
  {
    visitBlocks(mesh, this->options.progress, part.begin, part.end, visit);
    // Passes of solves are added with their reports.
    ++this->report.passes;
  }
  /** What is left of the memory limit beside `own` bytes. */
  std::int64_t memoryBeside(std::int64_t own) const;
  /** Returns solve(options), with options for a solve in the memory beside `own` bytes; errors
   * state the limit of the job. */
  template <class Solve>
  auto solveBeside(std::int64_t own, ProgressPart part, const Solve& solve) const
  {
    SolveOptions solving = this->options;
    solving.memoryLimit = this->memoryBeside(own);
    solving.progress = part.of(this->options.progress);
    try
    {
      return solve(solving);
    }
    catch (const MemoryLimitError& error)
    {
      // The message has to state the limit that the user knows.
      throw error.inside(own, this->options.memoryLimit);
    }
  }
  std::unique_ptr<Solution> solve(
    MeshSource& mesh, Problem& problem, ProgressPart part, std::int64_t own) const
  {
    return this->solveBeside(
      own, part, [&](const SolveOptions& solving) { return smg::solve(mesh, problem, solving); });
  }
  /** To be called at the end, which may cancel like any other. Throws Cancelled. */
  void endProgress() const;
  /** Adds memory, scratch files and times to the report. */
  void finishReport();

  /** Scratch files of solves and selections are made in the folder of the job, which counts them
   * for one common limit. */
  SolveOptions options;
  Pool pool;
  std::optional<ScratchFolder> scratch; ///< none in core
  ScratchTraffic traffic;               ///< of the job alone
  Report report;

protected:
  Timer Wall;

private:
  double CpuAtStart = processSeconds();
};

} // namespace smg
