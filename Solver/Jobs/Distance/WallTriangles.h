// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenFacets.h"
#include "Solver/Files/ScratchBlocks.h"
#include "Solver/Jobs/Distance/DistanceSources.h"
#include "Solver/Jobs/Distance/TriangleTree.h"
#include "Solver/Memory/Ring.h"

#include <array>
#include <cstdint>
#include <vector>

namespace smg
{

/** A triangle of a wall: its corners, and their numbers in the original file. */
struct WallTriangle
{
  TrianglePoints points;
  std::array<std::int64_t, 3> numbers;
};

/** Collects the wall of a tetrahedral mesh in one reading, in the order of the stream: its boundary
 * triangles, or those that are selected. Cells that are flagged as duplicates or use a vertex twice
 * do not count. */
class WallTriangles
{
public:
  /** Block n of `to` gets the triangles from n * BlockTriangles on. */
  static constexpr std::int64_t BlockTriangles = 4096;

  /** `selected` is null if all of the boundary is wall. */
  WallTriangles(ScratchBlocks& to, DistanceSources& numbers, bool everywhere, Pool& pool);

  /** Adds the next block, which has been checked: see StreamCheck. */
  void add(const MeshBlock& block);
  /** To be called after the last block. */
  void finish();

  std::int64_t count() const { return this->Count; }

private:
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);
  /** Takes the boundary triangles whose lowest vertex is below `end`. */
  void take(std::int64_t end);
  void writeBlock();

  ScratchBlocks& To;
  DistanceSources& From;
  bool Everywhere;
  OpenFacets Open;
  Ring<double> Points;
  Ring<std::int64_t> Numbers;
  std::vector<WallTriangle> Block; ///< not yet written
  std::int64_t Vertices = 0, Final = 0, Count = 0;
};

} // namespace smg
