// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>

namespace smg
{

/** Measures the waiting time of its thread since construction: wall time minus CPU time. */
class WaitClock
{
public:
  std::int64_t nanoseconds() const
  {
    const std::int64_t passed = now(CLOCK_MONOTONIC) - this->Begin;
    const std::int64_t worked = now(CLOCK_THREAD_CPUTIME_ID) - this->WorkBegin;
    return std::max<std::int64_t>(0, passed - worked);
  }

private:
  static std::int64_t now(clockid_t clock)
  {
    timespec time{};
    clock_gettime(clock, &time);
    return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
  }

  std::int64_t Begin = now(CLOCK_MONOTONIC);
  std::int64_t WorkBegin = now(CLOCK_THREAD_CPUTIME_ID);
};

} // namespace smg
