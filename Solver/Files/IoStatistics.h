// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace smg
{

/** The total traffic of any number of files. */
struct IoStatistics
{
  std::atomic<std::int64_t> bytesRead{ 0 };
  std::atomic<std::int64_t> bytesWritten{ 0 };
  /** Nanoseconds in which a caller waited for the disk. */
  std::atomic<std::int64_t> waitNanoseconds{ 0 };
};

} // namespace smg
