// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"
#include "IO/Order/StreamOrder.h"
#include "Solver/Core/Progress.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** A mesh in memory as a compact stream: which cell comes when, and what is known of the whole. */
struct StreamLayout
{
  std::vector<std::uint32_t> cells;       ///< the mesh's cells in stream order
  std::vector<std::uint8_t> flags;        ///< CellFlag bits of each, in stream order
  std::vector<std::uint32_t> vertices;    ///< the mesh's vertices in stream order
  std::vector<std::uint32_t> streamIndex; ///< of each of the mesh's vertices
  std::vector<std::uint32_t> lastCell;    ///< last cell, in stream order, of each stream vertex

  std::int64_t isolatedVertices = 0;
  std::int64_t degenerateCells = 0;
  std::int64_t duplicateCells = 0;
  std::int64_t components = 0;
  /** Edges of one triangle alone, and of more than two; -1 for tetrahedra. */
  std::int64_t boundaryEdges = -1;
  std::int64_t nonManifoldEdges = -1;
};

/**
 * Brings the mesh into the order. Takes O(n log n) time at most.
 * @throws Error for the spectral order, and for 2^32 - 1 vertices or cells and more; Cancelled
 */
StreamLayout layOut(
  const IndexedMesh& mesh, StreamOrder order, const ProgressFunction& progress = {});

} // namespace smg
