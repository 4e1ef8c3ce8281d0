// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Bytes of a tuple of each of the columns, and `more`. */
inline std::int64_t rowBytes(const std::vector<ColumnSpec>& columns, std::int64_t more = 0)
{
  for (const ColumnSpec& column : columns)
  {
    more += static_cast<std::int64_t>(column.tupleBytes());
  }
  return more;
}

/** Bytes of the coordinates of a vertex. */
inline std::int64_t positionBytes(const StreamInfo& mesh)
{
  return 3 * static_cast<std::int64_t>(mesh.doublePositions ? sizeof(double) : sizeof(float));
}

/** Bytes of all columns of a mesh. */
inline std::int64_t columnBytes(const StreamInfo& mesh)
{
  return mesh.vertices * rowBytes(mesh.vertexColumns) + mesh.cells * rowBytes(mesh.cellColumns);
}

} // namespace smg
