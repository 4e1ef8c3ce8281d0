// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Pool.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <limits>
#include <string>

namespace smg
{

std::string memoryLimitSentence(
  std::int64_t needed, std::int64_t allowed, const PoolUse& use, std::int64_t usual)
{
  const std::string usually =
    usual > 0 ? " (about " + mebibytes(usual) + " usually suffice)" : std::string();
  return std::string(use.operation) + " needs at least " + exactMebibytes(needed) + " of memory" +
         usually + " but the limit is " + exactMebibytes(allowed) + ": " + use.advice;
}

void Pool::acquire(std::int64_t bytes)
{
  const std::lock_guard lock(this->Mutex);
  // A damaged file may request any size: the sum must not overflow.
  if (bytes < 0 || bytes > this->Limit - this->Used)
  {
    constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
    const bool fits = bytes >= 0 && bytes <= Most - this->Used;
    throw MemoryLimitError(fits ? this->Used + bytes : Most, this->Limit, this->Use);
  }
  this->Used += bytes;
  this->Peak = std::max(this->Peak, this->Used);
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
  this->Recent = this->Used;
}

void Pool::raisePeak(std::int64_t bytes)
{
  const std::lock_guard lock(this->Mutex);
  this->Peak = std::max(this->Peak, bytes);
}

} // namespace smg
