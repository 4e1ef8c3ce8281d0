// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/CheckOptions.h"

#include "smg/Error.h"

#include <string>

namespace smg
{

void require(bool holds, const std::string& sentence)
{
  if (!holds)
  {
    throw Error(sentence);
  }
}

/** The difference vertices - count cannot overflow, as first + count could: both are at least 0
 * when it is formed. */
void checkVertexRange(
  std::int64_t first, std::int64_t count, std::size_t room, std::int64_t vertices)
{
  if (first < 0 || count < 0 || first > vertices - count || room < static_cast<std::size_t>(count))
  {
    throw Error(std::to_string(count) + " vertices from " + std::to_string(first) +
                " on were asked of a solution of " + std::to_string(vertices) +
                ", or there is no room for their values");
  }
}

} // namespace smg
