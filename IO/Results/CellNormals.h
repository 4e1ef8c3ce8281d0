// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

namespace smg
{

/** A triangle's unit normal and its angles; all zero if it has no area. */
struct TriangleShape
{
  std::array<double, 3> normal{};
  std::array<double, 3> angles{}; ///< radians, at the corners a, b, c
};

/** The shape of a triangle; its normal is that of (b - a) x (c - a). */
SMG_EXPORT TriangleShape shapeOfTriangle(
  std::span<const double, 3> a, std::span<const double, 3> b, std::span<const double, 3> c);

/** The shapes of the triangles of a mesh stream, block by block; stores the positions of the
 * vertices that are not final. */
class CellNormals
{
public:
  /** At most `memory` bytes are in memory; the rest is in a scratch file in `scratch` (empty: the
   * system's temporary folder). */
  CellNormals(const std::filesystem::path& scratch, std::int64_t memory);

  /** Adds the vertices of the next block. */
  void take(const MeshBlock& block);
  /** The shape of cell `cell`, counted from 0, of the last block. */
  TriangleShape shape(const MeshBlock& block, std::size_t cell);
  /** Adds the next block and writes the normals of its cells, 3 floats per cell. */
  void read(const MeshBlock& block, std::span<float> normals);
  /** Releases the vertices that are final after the block. */
  void release(const MeshBlock& block);

private:
  ScratchFolder Scratch;
  PagedArray<std::array<double, 4>> Positions; ///< x, y, z, by stream index
};

} // namespace smg
