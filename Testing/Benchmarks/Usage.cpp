// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Usage.h"

#include "smg/Error.h"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>
#include <string>

namespace smg::benchmark
{

double cpuSeconds()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time)
  { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::int64_t peakBytes()
{
  // Not rusage's ru_maxrss, which cannot be reset and which a child inherits from its parent.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == "VmHWM:")
    {
      std::int64_t kibibytes = 0;
      status >> kibibytes;
      return 1024 * kibibytes;
    }
  }
  throw Error("/proc/self/status has no VmHWM: the peak memory cannot be measured.");
}

void resetPeak()
{
  malloc_trim(0);
  std::ofstream clear("/proc/self/clear_refs");
  if (!(clear << "5" << std::flush))
  {
    throw Error("/proc/self/clear_refs cannot be written: the peak memory cannot be measured.");
  }
}

} // namespace smg::benchmark
