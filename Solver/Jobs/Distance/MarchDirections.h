// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Files/BlockStore.h"
#include "Solver/Jobs/Distance/Arrival.h"
#include "Solver/Jobs/Distance/MarchWindow.h"

#include <cstdint>

namespace smg
{

/**
 * The gradient of a distance at the vertices, computed in one pass over the mesh: the direction in
 * which the shortest path arrives. 0 at sources and at vertices that are not reached.
 */
class MarchDirections
{
public:
  MarchDirections(ChunkedMesh& mesh, Pool& pool);

  /** The bytes for chunks with at most this many inner and crossing cells. */
  static std::int64_t bytes(const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells,
    std::int64_t crossingCells);

  /** Writes three floats per vertex; block n has those of chunk n. */
  void write(BlockStore& to, Progress& progress);

private:
  /** Updates the directions at the corners of these cells. */
  template <int Corners>
  void addCells(std::span<const std::uint32_t> corners);
  void addChunk(std::int64_t chunk);

  MarchWindow Window;
  Buffer Memory;
  double* Shortest; ///< the length of the shortest path so far, by place
  float* Direction; ///< its direction, 3 per place
};

} // namespace smg
