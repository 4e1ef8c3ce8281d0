// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Values/JobRun.h"

#include "Solver/Files/ScratchAccount.h"

#include <algorithm>

// What all jobs have around their computation.

namespace smg
{

JobRun::JobRun(const SolveOptions& jobOptions, const PoolUse& use)
  : options(jobOptions)
  , pool(jobOptions.memoryLimit, use)
{
  if (!jobOptions.inCore)
  {
    this->scratch.emplace(jobOptions.scratch, jobOptions.scratchLimit);
    this->options.scratch = this->scratch->path();
  }
}

std::int64_t JobRun::memoryBeside(std::int64_t own) const
{
  return std::max<std::int64_t>(this->options.memoryLimit - own, 1);
}

void JobRun::endProgress() const
{
  Progress(this->options.progress).update(1.0);
}

void JobRun::finishReport()
{
  Report& r = this->report;
  for (const auto& [name, level, statistics] : this->traffic.kinds())
  {
    r.bytes_by_kind.push_back({ name, level, statistics.bytesRead, statistics.bytesWritten });
  }
  r.bytes_read += this->traffic.bytesRead();
  r.bytes_written += this->traffic.bytesWritten();
  r.pool_bytes_peak = std::max(r.pool_bytes_peak, this->pool.peak());
  r.rss_bytes_peak = peakResidentBytes();
  r.scratch_bytes_peak = this->scratch ? this->scratch->account().peak() : 0;
  r.seconds.io_wait += this->traffic.waitSeconds();
  r.seconds.total = this->Wall.seconds();
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
}

} // namespace smg
