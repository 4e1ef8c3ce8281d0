// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/DistanceRun.h"

#include "Solver/Files/ScratchAccount.h"

namespace smg
{

void DistanceRun::endPass(double unsettled)
{
  const Report::Pass now = this->now();
  this->report.by_pass.push_back({ unsettled, now.seconds - this->Before.seconds,
    now.read - this->Before.read, now.written - this->Before.written, now.pool_bytes });
  this->Before = now;
}

void DistanceRun::finishReport()
{
  Report& r = this->report;
  r.pool_bytes_peak = this->pool.peak();
  r.rss_bytes_peak = peakResidentBytes();
  r.scratch_bytes_peak = this->scratch.account().peak();
  for (const auto& [name, level, statistics] : this->traffic.kinds())
  {
    r.bytes_by_kind.push_back({ name, level, statistics.bytesRead, statistics.bytesWritten });
  }
  r.bytes_read = this->traffic.bytesRead();
  r.bytes_written = this->traffic.bytesWritten();
  r.seconds.io_wait = this->traffic.waitSeconds();
  r.seconds.total = this->Wall.seconds();
  r.seconds.solve = r.seconds.total - r.seconds.build;
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
}

} // namespace smg
