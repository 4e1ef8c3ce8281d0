// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/ScratchBlocks.h"
#include "Solver/Jobs/Distance/TriangleTree.h"
#include "Solver/Jobs/Distance/WallTriangles.h"

#include <tbb/task_arena.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace smg
{

/** The results of a wall distance at vertices, in chunks on a scratch file. */
struct WallValues
{
  static constexpr std::int64_t ChunkVertices = 16384;
  enum Part
  {
    Distances,  ///< doubles
    Sources,    ///< 64-bit integers
    Directions, ///< three floats a vertex
    Parts
  };
  /** Bytes that a pass holds for each vertex of a chunk, with its position. */
  static constexpr std::int64_t VertexBytes = 3 * 8 + 8 + 8 + 3 * 4;

  ScratchBlocks& file; ///< block chunk * Parts + Part
  bool sources = false, directions = false;
};

/** A pass over the vertices of a mesh with a part of its wall: lowers their distances. */
class WallPass
{
public:
  /** `points` and `numbers` are those of the triangles; `isFirst`: there are no values yet. */
  WallPass(std::span<const TrianglePoints> points,
    std::span<const std::array<std::int64_t, 3>> numbers, bool isFirst, WallValues values,
    Pool& pool);

  /** Adds the positions of the next vertices. */
  void add(std::span<const double> positions, tbb::task_arena& threads);
  /** To be called after the last vertices. */
  void finish(tbb::task_arena& threads);

private:
  void lowerChunk(tbb::task_arena& threads);
  /** Lowers the values of the vertices [begin, end) of the chunk. */
  void lower(std::int64_t begin, std::int64_t end);
  void loadChunk();
  void writeChunk();
  /** Calls visit(part, values) for the parts that are wanted. */
  void forParts(auto visit);

  std::span<const TrianglePoints> Points;
  std::span<const std::array<std::int64_t, 3>> Numbers;
  TriangleTree Tree;
  bool IsFirst;
  WallValues Values;
  Buffer Memory;
  std::span<double> Position, Distance;
  std::span<std::int64_t> Source;
  std::span<float> Direction;
  std::int64_t Chunk = 0, Count = 0; ///< the chunk, and its vertices so far
};

} // namespace smg
