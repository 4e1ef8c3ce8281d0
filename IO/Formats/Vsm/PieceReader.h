// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VertexReader.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** Reads pieces of a .vsm file. Stores the vertices of the pieces read so far that later cells use,
 * so that pieces in order read every block once. */
class PieceReader
{
public:
  PieceReader(VsmFile& file, const std::vector<std::string>& vertexColumns,
    const std::vector<std::string>& cellColumns);

  void read(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece);

private:
  /** Fills the corners, as stream indices, and the columns of the cells. */
  void readCells(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece);
  /** The number of vertices that the cells before `cell` introduce. */
  std::int64_t introducedBefore(std::int64_t cell);
  const std::vector<std::int64_t>& cornersOfBlock(std::int64_t block);
  /** Fills Rows with the ghosts, which ascend, and the vertices [begin, end). */
  void collect(std::span<const std::int64_t> ghosts, std::int64_t begin, std::int64_t end);
  /** Keeps those of the old and the new vertices below `end` that outlive cell endCell - 1. */
  void remember(std::int64_t end, std::int64_t endCell);

  VsmFile& File;
  int Corners;
  std::vector<ColumnSpec> VertexSpecs, CellSpecs;
  VertexReader InOrder;  ///< for vertices that a piece introduces
  VertexReader Anywhere; ///< for older ones that are not stored
  std::vector<RowReader> CellColumns;

  std::int64_t Block = -1; ///< block of the cells that BlockCorners are of
  std::vector<std::int64_t> BlockCorners;
  std::vector<std::int64_t> Ghosts, Missing;
  VertexRows Rows, Fetched, Alive, NextAlive;
};

} // namespace smg
