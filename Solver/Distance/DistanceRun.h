// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Core/Timer.h"
#include "Solver/Storage/Pool.h"
#include "Solver/Storage/ScratchFolder.h"
#include "Solver/Storage/ScratchTraffic.h"
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

  /** Adds memory, scratch files and times to the report. */
  void finishReport();

  DistanceOptions options;
  Progress progress;
  Pool pool;
  ScratchFolder scratch;
  ScratchTraffic traffic;
  Report report;

private:
  Timer Wall;
  double CpuAtStart = processSeconds();
};

} // namespace smg
