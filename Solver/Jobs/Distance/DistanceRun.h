// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Core/Timer.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/ScratchTraffic.h"
#include "Solver/Memory/Pool.h"
#include "smg/Distance.h"
#include "smg/Report.h"

namespace smg
{

/** The use of memory of a distance. */
inline constexpr PoolUse DistanceMemory{ "a distance",
  "raise the memory limit, or convert the mesh with the order bfs" };

/** What all parts of a distance and its solution share. */
struct DistanceRun
{
  explicit DistanceRun(const DistanceOptions& distanceOptions)
    : options(distanceOptions)
    , progress(distanceOptions.progress)
    , pool(distanceOptions.memoryLimit, DistanceMemory)
    , scratch(distanceOptions.scratch, distanceOptions.scratchLimit)
  {
  }

  /** Before the first pass: what was until then is of none. */
  void beginPasses() { this->Before = this->now(); }
  /** Adds a pass to the report; `unsettled` is the share of the vertices that have changes to pass
   * on. */
  void endPass(double unsettled);
  /** Adds memory, scratch files and times to the report. */
  void finishReport();

  DistanceOptions options;
  Progress progress;
  Pool pool;
  ScratchFolder scratch;
  ScratchTraffic traffic;
  Report report;

private:
  /** What has been until now, as of one pass. */
  Report::Pass now() const
  {
    return { 0.0, this->Wall.seconds(), this->traffic.bytesRead(), this->traffic.bytesWritten(),
      this->pool.peak() };
  }

  Report::Pass Before;
  Timer Wall;
  double CpuAtStart = processSeconds();
};

} // namespace smg
