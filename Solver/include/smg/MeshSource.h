// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Export.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace smg
{

/** The type of the cells of a mesh stream; the value is the number of corners of a cell. */
enum class CellType : std::uint8_t
{
  Triangle = 3,
  Tetrahedron = 4
};

constexpr int cornersOf(CellType type)
{
  return static_cast<int>(type);
}

/** Name of the optional uint8 cell column that marks cells without weight (see CellFlag). */
inline constexpr const char* CellFlagsName = "CellFlags";

/** Bits of the `CellFlags` column. A cell with a set bit is part of the mesh but has no weight. */
enum CellFlag : std::uint8_t
{
  DegenerateCell = 1, ///< repeated corners, or zero area or volume
  DuplicateCell = 2   ///< an earlier cell has the same corners
};

/**
 * Information on a mesh stream that is known before it is read.
 *
 * A mesh stream is *compact*: stream indices number the vertices 0, 1, ... in the order in which
 * the cells first use them, so cell c uses vertices introduced by cells 0..c only, and every vertex
 * belongs to at least one cell.
 */
struct StreamInfo
{
  CellType cellType = CellType::Triangle;
  std::int64_t vertices = 0;
  std::int64_t cells = 0;
  /** xmin, xmax, ymin, ymax, zmin, zmax. */
  std::array<double, 6> bounds{};
  /** The maximum number of simultaneously active vertices; -1 if unknown. */
  std::int64_t width = -1;
  /** The largest index distance between two vertices of a cell; -1 if unknown. */
  std::int64_t span = -1;
  /** Whether positions have double precision (otherwise single precision). */
  bool doublePositions = true;
  /** The attribute columns of blocks, in this order. */
  std::vector<ColumnSpec> vertexColumns;
  std::vector<ColumnSpec> cellColumns;
};

/** The next part of a mesh stream: vertices, followed by cells that use these or earlier ones.
 * Blocks may have any size, and may have no vertices or no cells, but not both. */
struct MeshBlock
{
  std::int64_t firstVertex = 0;      ///< stream index of the block's first vertex
  std::int64_t firstCell = 0;        ///< stream index of the block's first cell
  std::vector<double> positions;     ///< x, y, z of each vertex of the block
  std::vector<std::int64_t> corners; ///< stream indices, cornersOf(cellType) per cell
  std::vector<Column> vertexColumns; ///< as StreamInfo::vertexColumns, a tuple per vertex
  std::vector<Column> cellColumns;   ///< as StreamInfo::cellColumns, a tuple per cell
  /** No cell after this block uses a vertex with a stream index below this one. */
  std::int64_t finalized = 0;

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->positions.size() / 3); }

  /** The column of CellFlag bits of the cells; null if the block has none. */
  const Column* flags() const
  {
    const auto found = std::ranges::find(
      this->cellColumns, CellFlagsName, [](const Column& column) { return column.spec.name; });
    return found == this->cellColumns.end() ? nullptr : &*found;
  }
};

/** Delivers a mesh stream once, from the first block to the last. */
class SMG_EXPORT MeshSource
{
public:
  virtual ~MeshSource() = default;

  /** Valid from construction on. */
  virtual const StreamInfo& info() const = 0;

  /** Fills `block`, reusing the memory of its vectors; returns false at the end. Throws Error.
   * Called on the solving thread. */
  virtual bool next(MeshBlock& block) = 0;
};

} // namespace smg
