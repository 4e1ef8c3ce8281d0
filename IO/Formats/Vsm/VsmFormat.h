// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace smg
{

/**
 * A .vsm file ("VTK streaming mesh") is a block file (BlockFile.h) of these tables:
 *
 * - vertices: `Position`, three float32 or float64, then the attribute columns.
 * - last: `LastCell`, the last cell that uses a vertex; blocks of BlockRows rows. Packed
 *   (PackedIntegers.h) as differences from the vertex before, in zigzag form, the first from 0.
 * - cells: `Corners`, then the attribute columns. Packed, a corner is its distance back from the
 *   number of vertices introduced so far: 0 introduces the next one.
 * - blocks: a row for each block of the cells. `FirstVertex` is the number of vertices introduced
 *   before the block; no cell after the block uses a vertex below `Finalized`.
 * - isolated: the vertices of no cell, which are not part of the stream: `Id`, the index in the
 *   original file (int64), `Position`, then the attribute columns like those of the vertices. Files
 * of the first four tables only have no such vertices.
 * - groups: one row, `Json`, the text of the groups and their sets (IO/Mesh/GroupsJson.h). Only
 * files with groups have it; older ones have them in the header.
 *
 * VsmBlockRows (VsmBuffers.h) has the rows of the blocks. The header contains kind, cell
 * ("triangle" or "tetrahedron"), precision ("float32" or "float64"), vertices, cells, bounds (xmin,
 * xmax, ymin ...), width, span and mean_width, and may have `origin`, a text of the program that
 * made the file.
 */
struct VsmFormat
{
  static constexpr const char* Kind = "mesh stream";
  enum Table
  {
    Vertices,
    Last,
    Cells,
    Blocks,
    Isolated,
    Groups
  };
  /** The number of tables of every file. */
  static constexpr int MinTables = Isolated;
  /** The most rows of a block. */
  static constexpr std::int64_t BlockRows = 8192;
  /** Rows with more bytes are wide: their blocks have about WideBlockBytes. */
  static constexpr std::int64_t WideRow = 256, WideBlockBytes = std::int64_t(512) << 10;
  /** Rows that are read or written at once, if they have so many bytes. */
  static constexpr std::int64_t blockRows(std::int64_t rowBytes)
  {
    return rowBytes <= WideRow ? BlockRows
                               : std::clamp<std::int64_t>(WideBlockBytes / rowBytes, 1, BlockRows);
  }
  /** Of the memory for reading, the largest blocks have at most a fraction: the block that is used,
   * the one after it, and what is made of them. */
  static constexpr std::int64_t BlocksInUse = 4;
  /** The most attribute columns of vertices or of cells. */
  static constexpr std::size_t MaxColumns = 4096;
};

} // namespace smg
