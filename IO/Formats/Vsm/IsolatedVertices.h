// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

#include <cstdint>
#include <vector>

namespace smg
{

/**
 * Vertices of no cell. A mesh stream has none; its container keeps them beside it, for whoever
 * writes the mesh as its original file had it.
 */
struct IsolatedVertices
{
  std::vector<std::int64_t> ids; ///< places in the original file
  std::vector<double> positions; ///< x, y, z of each vertex
  std::vector<Column> columns;   ///< a tuple a vertex, of the columns that the stream has
};

} // namespace smg
