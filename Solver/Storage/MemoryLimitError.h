// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Pool.h"
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
  MemoryLimitError(std::int64_t needed, std::int64_t allowed, const PoolUse& use = SolveMemory)
    : Error(memoryLimitSentence(needed, allowed, use))
    , Needed(needed)
    , Use(use)
  {
  }

  /** The error of an operation that holds `own` bytes beside the part that failed, all of it within
   * the limit `allowed`. */
  MemoryLimitError inside(std::int64_t own, std::int64_t allowed) const
  {
    constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
    return { std::min(this->Needed, Most - own) + own, allowed, this->Use };
  }

private:
  std::int64_t Needed;
  PoolUse Use;
};

} // namespace smg
