// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartMemory.h"

#include "Solver/Core/ByteText.h"
#include "smg/Error.h"

#include <HYPRE_utilities.h>

#include <limits>
#include <string>

namespace smg
{

double partMemory(std::int64_t vertices, std::int64_t cells, int columns)
{
  // 1.2 times what was measured: 753 bytes for a vertex of a surface, with its two cells, 1241 for
  // one of a solid, with its six, and 56 for each further column.
  constexpr double OfVertex = 530.0, OfColumn = 70.0, OfCell = 150.0;
  return static_cast<double>(vertices) * (OfVertex + OfColumn * columns) +
         static_cast<double>(cells) * OfCell;
}

std::int64_t mostPartVertices()
{
  return std::numeric_limits<HYPRE_Int>::max() / 64;
}

void checkPartMemory(std::int64_t vertices, std::int64_t cells, int columns, std::int64_t limit)
{
  const double needed = partMemory(vertices, cells, columns);
  if (needed > static_cast<double>(limit))
  {
    throw Error("the matrix of a process and its hierarchy need about " +
                mebibytes(static_cast<std::int64_t>(needed)) + ", more than the memory limit of " +
                mebibytes(limit) +
                ": raise the memory limit, use more processes, or use the streaming engine");
  }
}

} // namespace smg
