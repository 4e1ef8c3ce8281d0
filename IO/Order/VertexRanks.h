// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"
#include "IO/Order/VertexCells.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace smg
{

/** The place of each vertex in an order of the vertices; isolated vertices have any. */
using VertexRanks = std::vector<std::uint32_t>;

struct BreadthFirstResult
{
  VertexRanks ranks;
  std::int64_t components = 0;
};

/**
 * Breadth-first along the edges, component after component. Each component is begun at a vertex as
 * far out as can be had cheaply (pseudo-peripheral): the last one of a search that was begun at the
 * last one of another search. `tick` is called now and then with the fraction done.
 */
BreadthFirstResult breadthFirstRanks(
  const IndexedMesh& mesh, const VertexCells& cells, const std::function<void(double)>& tick);

/** Along the longest side of the bounds of the vertices that have cells; ties by index. */
VertexRanks axisRanks(const IndexedMesh& mesh);

/** As the cells of the mesh first use them. */
VertexRanks firstUseRanks(const IndexedMesh& mesh);

} // namespace smg
