// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Files/ScratchBlocks.h"
#include "Solver/Jobs/Distance/Arrival.h"
#include "Solver/Jobs/Distance/MarchWindow.h"

#include <cstdint>

namespace smg
{

/**
 * The gradient of a distance at the vertices: the direction of the shortest path where it arrives,
 * in one pass over the mesh. 0 at sources and at vertices that are not reached.
 */
class MarchDirections
{
public:
  MarchDirections(ChunkedMesh& mesh, Pool& pool);

  /** Memory for chunks of at most so many cells, inner and crossing ones. */
  static std::int64_t bytes(const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells,
    std::int64_t crossingCells);

  /** Writes three floats a vertex; block n has those of chunk n. */
  void write(ScratchBlocks& to, Progress& progress);

private:
  /** Takes note of the paths through some cells. */
  template <int Corners>
  void addCells(std::span<const std::uint32_t> corners);
  void addChunk(std::int64_t chunk);

  MarchWindow Window;
  Buffer Memory;
  double* Shortest; ///< distance of the paths so far, by place
  float* Direction; ///< of the shortest one
};

} // namespace smg
