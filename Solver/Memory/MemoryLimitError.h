// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "smg/Error.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace smg
{

/** The error of a memory limit that is too low. */
class SMG_EXPORT MemoryLimitError : public Error
{
public:
  /** `usual`: bytes that suffice as a rule for such an operation, 0 if unknown. */
  MemoryLimitError(std::int64_t needed, std::int64_t allowed, const PoolUse& use = SolveMemory,
    std::int64_t usual = 0)
    : Error(memoryLimitSentence(needed, allowed, use, usual))
    , Needed(needed)
    , Allowed(allowed)
    , Usual(usual)
    , Use(use)
  {
  }

  /** The same error of an operation that is expected to need so many bytes, 0 if unknown. The part
   * that failed may be any of many. */
  MemoryLimitError expecting(std::int64_t bytes) const
  {
    if (bytes == 0)
    {
      return *this;
    }
    const std::int64_t sufficient = plus(bytes, bytes / 2); // measured: up to 1.3 times as many
    return { this->Needed, this->Allowed, this->Use,
      std::max(sufficient, plus(this->Needed, this->Needed / 4)) };
  }

  /** The error of an operation that holds `own` bytes beside the part that failed, all of it within
   * the limit `allowed`. */
  MemoryLimitError inside(std::int64_t own, std::int64_t allowed) const
  {
    const std::int64_t usual = this->Usual > 0 ? plus(this->Usual, own) : 0;
    return { plus(this->Needed, own), allowed, this->Use, usual };
  }

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

} // namespace smg
