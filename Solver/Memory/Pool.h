// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstdint>
#include <limits>
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
  "raise the memory limit, use fewer sweeps, or convert the mesh with the order bfs if it has "
  "another" };

/** Of a problem that couples vertices. */
inline constexpr PoolUse CoupledSolveMemory{ "the solve",
  "raise the memory limit, use fewer sweeps, or, if the stream is not made for this problem, "
  "convert the mesh file with --problem, which keeps coupled vertices near each other" };

/**
 * Accounts for the large memory of an operation and enforces its limit: a request above it throws
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
  /** Raises the peak to at least `bytes`, which a program has used that this one continues. */
  void raisePeak(std::int64_t bytes);
  std::int64_t limit() const { return this->Limit; }
  /** Memory in use stays, even if it is more than the new limit. No other thread may acquire
   * meanwhile. */
  void setLimit(std::int64_t limit) { this->Limit = limit; }

private:
  PoolUse Use;
  std::int64_t Limit;
  mutable std::mutex Mutex;
  std::int64_t Used = 0;
  std::int64_t Peak = 0, Recent = 0;
};

/** "the solve needs at least ... MiB of memory but the limit is ... MiB: ..."; with `usual` bytes,
 * 0 if unknown, "the solve needs about ... MiB of memory (at least ... bytes) but ...". */
SMG_EXPORT std::string memoryLimitSentence(std::int64_t needed, std::int64_t allowed,
  const PoolUse& use = SolveMemory, std::int64_t usual = 0);

/** The kind of all errors of a memory limit that is too low, whatever it limits. */
class SMG_EXPORT MemoryError : public Error
{
public:
  using Error::Error;
};

/** That of an operation, which knows the bytes that it needs. */
class SMG_EXPORT MemoryLimitError : public MemoryError
{
public:
  /** `usual`: bytes that suffice as a rule for such an operation, 0 if unknown. */
  MemoryLimitError(std::int64_t needed, std::int64_t allowed, const PoolUse& use = SolveMemory,
    std::int64_t usual = 0)
    : MemoryError(memoryLimitSentence(needed, allowed, use, usual))
    , Needed(needed)
    , Allowed(allowed)
    , Usual(usual)
    , Use(use)
  {
  }

  /** The same error with a figure for the whole operation, which is expected to need `bytes` (0 if
   * unknown): the part that failed may be any of many. */
  MemoryLimitError expecting(std::int64_t bytes) const
  {
    if (bytes == 0)
    {
      return *this;
    }
    const std::int64_t sufficient = plus(bytes, bytes / 2); // measured: up to 1.3 times as many
    // Of small meshes buffers are the larger part, of which the expectation knows nothing.
    constexpr std::int64_t Smallest = std::int64_t(16) << 20;
    return { this->Needed, this->Allowed, this->Use,
      std::max({ sufficient, plus(this->Needed, this->Needed / 4), Smallest }) };
  }

  /** The same error for an operation that has `own` bytes beside the part that failed and whose
   * limit for both is `allowed`. */
  MemoryLimitError inside(std::int64_t own, std::int64_t allowed) const
  {
    const std::int64_t usual = this->Usual > 0 ? plus(this->Usual, own) : 0;
    return { plus(this->Needed, own), allowed, this->Use, usual };
  }

  /** The same error of another purpose. */
  MemoryLimitError of(const PoolUse& use) const
  {
    return { this->Needed, this->Allowed, use, this->Usual };
  }

  std::int64_t needed() const { return this->Needed; }

private:
  /** The sum, at most the largest number. */
  static std::int64_t plus(std::int64_t a, std::int64_t b)
  {
    constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
    return std::min(a, Most - b) + b;
  }

  std::int64_t Needed, Allowed, Usual;
  PoolUse Use;
};

/** Up to so many bytes of what is computed from a block of the stream are not accounted for, which
 * is enough for the blocks of usual streams. Where very many vertices become final at once there
 * is more, and that is accounted for. */
inline constexpr std::int64_t UnaccountedBytes = std::int64_t(4) << 20;

constexpr std::int64_t accountedBytes(std::int64_t bytes)
{
  return std::max<std::int64_t>(0, bytes - UnaccountedBytes);
}

/** Accounts in a pool for memory that another class allocates. */
class Reservation
{
public:
  explicit Reservation(Pool& pool, std::int64_t bytes = 0)
    : Owner(pool)
    , Bytes(bytes)
  {
    pool.acquire(bytes);
  }
  ~Reservation() { this->Owner.release(this->Bytes); }
  Reservation(const Reservation&) = delete;
  Reservation& operator=(const Reservation&) = delete;

  std::int64_t bytes() const { return this->Bytes; }
  /** Changes the reservation to `bytes`. Above the limit, throws Error and changes nothing. */
  void resize(std::int64_t bytes)
  {
    if (bytes > this->Bytes)
    {
      this->Owner.acquire(bytes - this->Bytes);
    }
    else if (bytes < this->Bytes)
    {
      this->Owner.release(this->Bytes - bytes);
    }
    this->Bytes = bytes;
  }

private:
  Pool& Owner;
  std::int64_t Bytes;
};

} // namespace smg
