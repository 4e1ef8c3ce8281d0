// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Core/Workers.h"
#include "Solver/Files/BlockStore.h"
#include "Solver/Jobs/Distance/DistanceSources.h"
#include "Solver/Jobs/Distance/TriangleFile.h"
#include "Solver/Memory/Ring.h"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

namespace smg
{

/** Collects the wall of a tetrahedral mesh in one reading, in the order of the stream: all boundary
 * triangles, or the selected ones; also triangles of groups between two cells. Cells that are
 * flagged as duplicates or use a vertex twice do not count. */
class WallTriangles
{
public:
  /** `numbers` selects the triangles and numbers their corners; `everywhere`: the whole boundary is
   * wall. */
  WallTriangles(BlockStore& to, DistanceSources& numbers, bool everywhere, Pool& pool);

  /** Adds the next block, which has been checked: see StreamCheck. */
  void add(const MeshBlock& block);
  /** To be called after the last block. */
  void finish();

  std::int64_t count() const { return this->To.count(); }

private:
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);
  /** Takes the triangles of the wall whose lowest vertex is below `end`. */
  void take(std::int64_t end);
  void add(std::int64_t middle, std::int64_t high, std::int32_t group);

  TriangleWriter To;
  DistanceSources& From;
  bool Everywhere;
  OpenFacets Open;
  struct OfGroup
  {
    std::int64_t middle, high;
    std::int32_t group; ///< see DistanceSources
  };
  /** Triangles that are selected as such, by their lowest corner, which is open. */
  std::map<std::int64_t, std::vector<OfGroup>> Inner;
  Ring<double> Points;
  Ring<std::int64_t> Numbers;
  std::int64_t Vertices = 0, Final = 0;
};

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
  /** Bytes of a vertex of a chunk during a pass: position, distance, source, direction. */
  static constexpr std::int64_t VertexBytes = 3 * 8 + 8 + 8 + 3 * 4;

  BlockStore& file; ///< block chunk * Parts + Part
  bool sources = false, directions = false;
};

/** A pass over the vertices of a mesh that lowers their distances to those from a part of the wall.
 */
class WallPass
{
public:
  /** `isFirst`: there are no values yet. */
  WallPass(const TrianglePart& part, bool isFirst, WallValues values, Pool& pool);

  /** Adds the positions of the next vertices. */
  void add(std::span<const double> positions, Workers& threads);
  /** To be called after the last vertices. */
  void finish(Workers& threads);

private:
  void lowerChunk(Workers& threads);
  /** Lowers the values of the vertices [begin, end) of the chunk. */
  void lower(std::int64_t begin, std::int64_t end);
  void loadChunk();
  void writeChunk();
  /** Calls visit(part, values) for the parts that are wanted. */
  void forParts(auto visit);

  const TrianglePart& Part;
  bool IsFirst;
  WallValues Values;
  Buffer Memory;
  std::span<double> Position, Distance;
  std::span<std::int64_t> Source;
  std::span<float> Direction;
  std::int64_t Chunk = 0, Count = 0; ///< the chunk, and its vertices so far
};

} // namespace smg
