// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <cstdint>
#include <mutex>
#include <string>

namespace smg
{

/** The purpose of a pool, for the error message of a limit that is too low. */
struct PoolUse
{
  const char* operation; ///< the operation that needs the memory
  const char* advice;    ///< the remedy
};

inline constexpr PoolUse SolveMemory{ "the solve",
  "raise the memory limit, convert the mesh with the order bfs, or use fewer sweeps" };

/**
 * Accounts for all block memory of an operation and enforces its limit: a request above it throws
 * an Error that names the required bytes, the allowed bytes and a remedy.
 *
 * The pool only counts; Ring and Buffer allocate the memory. Any thread may acquire and release.
 */
class SMG_EXPORT Pool
{
public:
  /** `limit` in bytes. */
  explicit Pool(std::int64_t limit, const PoolUse& use = SolveMemory)
    : Use(use)
    , Limit(limit)
  {
  }

  /** Adds `bytes`, at least 0, to the memory in use. Above the limit, throws Error and adds
   * nothing. */
  void acquire(std::int64_t bytes);
  void release(std::int64_t bytes);

  std::int64_t used() const;
  std::int64_t peak() const;
  /** The peak since it was last restarted. */
  std::int64_t recentPeak() const;
  void restartPeak();
  /** Counts an earlier use of so many bytes. */
  void raisePeak(std::int64_t bytes);
  std::int64_t limit() const { return this->Limit; }
  /** What is in use stays, even if it is more. Not while another thread acquires. */
  void setLimit(std::int64_t limit) { this->Limit = limit; }

private:
  PoolUse Use;
  std::int64_t Limit;
  mutable std::mutex Mutex;
  std::int64_t Used = 0;
  std::int64_t Peak = 0, Recent = 0;
};

/** "the solve needs at least ... MiB of memory but the limit is ... MiB: ..."; with `usual` bytes,
 * 0 if unknown, also "about ... MiB usually suffice". */
SMG_EXPORT std::string memoryLimitSentence(std::int64_t needed, std::int64_t allowed,
  const PoolUse& use = SolveMemory, std::int64_t usual = 0);

} // namespace smg
