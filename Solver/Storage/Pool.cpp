// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/Pool.h"

#include "Solver/Core/Error.h"

#include <algorithm>

namespace smg
{

std::string memoryLimitSentence(std::int64_t needed, std::int64_t allowed)
{
  const auto mebibytes = [](std::int64_t bytes)
  {
    return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB (" + std::to_string(bytes) +
           " bytes)";
  };
  return "the solve needs at least " + mebibytes(needed) + " of memory but the limit is " +
         mebibytes(allowed) +
         ": raise the memory limit, convert the mesh with the order bfs, or use fewer sweeps";
}

void Pool::acquire(std::int64_t bytes)
{
  if (this->Used + bytes > this->Limit)
  {
    throw Error(memoryLimitSentence(this->Used + bytes, this->Limit));
  }
  this->Used += bytes;
  this->Peak = std::max(this->Peak, this->Used);
}

} // namespace smg
