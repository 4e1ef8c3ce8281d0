// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>

namespace smg
{

/**
 * The number of vertices of a page for which a breadth-first search loads each page about once:
 * such that the pages at its front fit into the memory and the list of all pages is small. A power
 * of two.
 */
int choosePageVertices(
  CellType cellType, bool doublePositions, std::int64_t vertices, std::int64_t memory);

/** The share of directed edges that leave their page above which an order is bad: two to three
 * times that of meshes with useful coordinates. */
double mostCrossing(CellType cellType, int pageVertices);

} // namespace smg
