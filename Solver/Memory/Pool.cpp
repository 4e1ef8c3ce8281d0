// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Pool.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <limits>
#include <string>

// The accounted memory of an operation. The pool does not allocate: whoever does acquires the bytes
// first, so the limit is never exceeded by what is accounted for. What is not: small objects, code,
// stacks, and up to UnaccountedBytes of a block of the stream.

namespace smg
{

std::string memoryLimitSentence(
  std::int64_t needed, std::int64_t allowed, const PoolUse& use, std::int64_t usual)
{
  // What is missing at this moment does not suffice as a limit where the operation needs more later
  // on: the figure in MiB, which users follow, is that of all of it, if it is known.
  const std::string need = usual > 0 ? "about " + mebibytes(usual) + " of memory (at least " +
                                         std::to_string(needed) + " bytes)"
                                     : "at least " + exactMebibytes(needed) + " of memory";
  return std::string(use.operation) + " needs " + need + " but the limit is " +
         exactMebibytes(allowed) + ": " + use.advice;
}

void Pool::acquire(std::int64_t bytes)
{
  const std::lock_guard lock(this->Mutex);
  // The request may come from a damaged file and have any size: the sum must not overflow. Nothing
  // is added if it fails, so a caller may try with less.
  if (bytes < 0 || bytes > this->Limit - this->Used)
  {
    constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
    // The error names what would have been needed in all, as far as that is a number.
    const bool fits = bytes >= 0 && bytes <= Most - this->Used;
    throw MemoryLimitError(fits ? this->Used + bytes : Most, this->Limit, this->Use);
  }
  this->Used += bytes;
  this->Peak = std::max(this->Peak, this->Used);
  // Two peaks: of the whole operation, and since restartPeak(), by which a solve measures what one
  // of its passes needs.
  this->Recent = std::max(this->Recent, this->Used);
}

void Pool::release(std::int64_t bytes)
{
  const std::lock_guard lock(this->Mutex);
  this->Used -= bytes;
}

std::int64_t Pool::used() const
{
  const std::lock_guard lock(this->Mutex);
  return this->Used;
}

std::int64_t Pool::peak() const
{
  const std::lock_guard lock(this->Mutex);
  return this->Peak;
}

std::int64_t Pool::recentPeak() const
{
  const std::lock_guard lock(this->Mutex);
  return this->Recent;
}

void Pool::restartPeak()
{
  const std::lock_guard lock(this->Mutex);
  // What is in use at this moment counts, even if nothing is acquired in the new period.
  this->Recent = this->Used;
}

void Pool::raisePeak(std::int64_t bytes)
{
  const std::lock_guard lock(this->Mutex);
  this->Peak = std::max(this->Peak, bytes);
}

} // namespace smg
