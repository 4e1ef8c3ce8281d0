// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"
#include "IO/Order/VertexRanks.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** An order of the cells, and which of them come again. */
struct CellOrder
{
  std::vector<std::uint32_t> cells; ///< the cells in their new order
  std::vector<std::uint8_t>
    duplicates; ///< 1: the cell at this place has the corners of another one
};

/**
 * Sorts the cells by their largest rank, then by the next ones, then by their place in the mesh: a
 * cell comes as soon as its last vertex is reached. Cells with the same corners thus stand side by
 * side; the first one is no duplicate.
 */
CellOrder sortCells(const IndexedMesh& mesh, const VertexRanks& ranks);

} // namespace smg
