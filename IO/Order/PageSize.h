// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>

namespace smg
{

/**
 * The number of vertices of a page with which a breadth-first search needs each page about once: as
 * large as the pages of its frontier fit into the memory, and so large that the list of all pages
 * is small. A power of two.
 */
int choosePageVertices(
  CellType cellType, bool doublePositions, std::int64_t vertices, std::int64_t memory);

/**
 * The share of directed edges that leave their page above which an order is a bad one: twice or
 * three times what meshes with useful coordinates have.
 */
double mostCrossing(CellType cellType, int pageVertices);

} // namespace smg
