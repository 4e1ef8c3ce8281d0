// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg::benchmark
{

/** CPU seconds of all threads of this process so far, in the program and in the kernel. */
double cpuSeconds();

/** Peak resident memory in bytes since the start of the process or the last resetPeak(). */
std::int64_t peakBytes();

/** Returns freed memory to the system and begins a new measurement of peakBytes(). */
void resetPeak();

/** CPU seconds since its construction or the last lap. */
class CpuClock
{
public:
  double lap()
  {
    const double now = cpuSeconds();
    const double seconds = now - this->Last;
    this->Last = now;
    return seconds;
  }

private:
  double Last = cpuSeconds();
};

} // namespace smg::benchmark
