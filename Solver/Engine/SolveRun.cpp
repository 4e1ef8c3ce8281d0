// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/SolveRun.h"

#include "Solver/Engine/AssemblyReport.h"

#include <tbb/info.h>

#include <algorithm>

namespace smg
{
namespace
{

/** The number of compute threads for the requested number; 0: one per core. */
int computeThreads(int wanted)
{
  // In the first pass: the assembly, the coarsening of two levels (the others are small), the
  // downward part. In later passes: the upward part, the downward part, reading and writing.
  constexpr int ParallelStages = 4;
  const int most = std::min(ParallelStages, tbb::info::default_concurrency());
  return wanted > 0 ? std::min(wanted, most) : most;
}

} // namespace

SolveRun::SolveRun(int columns, const SolveOptions& solveOptions)
  : options(solveOptions)
  , progress(solveOptions.progress)
  , pool(solveOptions.memoryLimit)
  , components(columns, &this->pool)
  , labels(this->components)
  , free(this->components, this->labels, columns)
  , threads(computeThreads(solveOptions.threads))
{
  if (!solveOptions.inCore)
  {
    this->scratch.emplace(solveOptions.scratch);
  }
}

void SolveRun::beginReport()
{
  this->Wall = {};
  this->CpuAtStart = processSeconds();
}

void SolveRun::finishReport()
{
  Report& r = this->report;
  addAssemblyNotes(r);
  r.peak_nodes = this->resident.peak;
  r.pool_bytes_peak = this->pool.peak();
  r.rss_bytes_peak = peakResidentBytes();
  r.bytes_read = r.bytes_written = 0;
  r.bytes_by_kind.clear();
  for (const auto& [name, level, statistics] : this->traffic.kinds())
  {
    r.bytes_by_kind.push_back({ name, level, statistics.bytesRead, statistics.bytesWritten });
    r.bytes_read += statistics.bytesRead;
    r.bytes_written += statistics.bytesWritten;
  }
  r.seconds.io_wait = this->traffic.waitSeconds();
  r.seconds.total = this->Wall.seconds();
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
  r.threads = this->threads.max_concurrency();
}

} // namespace smg
