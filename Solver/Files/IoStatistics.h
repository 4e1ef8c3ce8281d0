// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <ctime>
#include <deque>
#include <string>
#include <utility>

namespace smg
{

/** The total traffic of any number of files. */
struct IoStatistics
{
  std::atomic<std::int64_t> bytesRead{ 0 };
  std::atomic<std::int64_t> bytesWritten{ 0 };
  /** Nanoseconds for which callers waited for the disk. */
  std::atomic<std::int64_t> waitNanoseconds{ 0 };
};

/** The traffic of the scratch files of a solve, per kind of file. */
class ScratchTraffic
{
public:
  struct Kind
  {
    std::string name;
    int level = NoLevel;
    IoStatistics statistics;
  };
  static constexpr int NoLevel = -1;

  /** Adds an account for a kind of file, of a level or of none. Its address does not change. */
  IoStatistics& add(std::string name, int level = NoLevel)
  {
    // A deque, not a vector: references to accounts are in use while others are added.
    Kind& kind = this->Kinds.emplace_back();
    kind.name = std::move(name);
    kind.level = level;
    return kind.statistics;
  }

  /** The account of this kind, added if necessary. */
  IoStatistics& of(const std::string& name, int level)
  {
    const auto found = std::ranges::find_if(
      this->Kinds, [&](const Kind& kind) { return kind.name == name && kind.level == level; });
    return found != this->Kinds.end() ? found->statistics : this->add(name, level);
  }

  /** Forgets what was read and written so far; no file may be in use. */
  void restart()
  {
    for (Kind& kind : this->Kinds)
    {
      kind.statistics.bytesRead = kind.statistics.bytesWritten = 0;
      kind.statistics.waitNanoseconds = 0;
    }
  }

  const std::deque<Kind>& kinds() const { return this->Kinds; }

  std::int64_t bytesRead() const { return this->sum(&IoStatistics::bytesRead); }
  std::int64_t bytesWritten() const { return this->sum(&IoStatistics::bytesWritten); }
  /** Seconds for which the callers of all files waited for the disk, summed over threads. */
  double waitSeconds() const
  {
    return 1e-9 * static_cast<double>(this->sum(&IoStatistics::waitNanoseconds));
  }

private:
  template <class Count>
  std::int64_t sum(Count IoStatistics::*count) const
  {
    std::int64_t all = 0;
    for (const Kind& kind : this->Kinds)
    {
      all += kind.statistics.*count;
    }
    return all;
  }

  std::deque<Kind> Kinds;
};

/** The time since construction for which its thread has waited: wall time minus processor time. */
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
