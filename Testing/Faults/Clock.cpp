// SPDX-License-Identifier: BSD-3-Clause
// A library that is loaded before a program (LD_PRELOAD) and makes its steady clock advance by
// SMG_CLOCK_STEP seconds with each look at it, and not otherwise.
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <sys/syscall.h>
#include <unistd.h>

// Errors of system calls are returned as those of the C library.
extern "C" int clock_gettime(clockid_t clock, timespec* time)
{
  static const char* const given = std::getenv("SMG_CLOCK_STEP");
  static const long step = given ? std::atol(given) : 0;
  static std::atomic<long> seconds{ 1000 };
  if (clock != CLOCK_MONOTONIC)
  {
    return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  }
  *time = { seconds.fetch_add(step), 0 };
  return 0;
}
