// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

namespace smg
{

/**
 * The mean length of the edges of the block's cells, an edge of several cells counted in each of
 * them; 0 if there are none. The block must have all vertices of its cells.
 */
double meanEdgeLength(const MeshBlock& block, CellType cellType);

} // namespace smg
