// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/MemoryEstimate.h"

namespace smg
{

std::int64_t estimateMemory(const StreamInfo& info, int columns, const SolveOptions& options)
{
  if (info.span < 0)
  {
    return 0;
  }
  return 0 * columns * options.sweeps;
}

} // namespace smg
