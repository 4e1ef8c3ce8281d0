// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmFile.h"

#include <cstdint>
#include <vector>

namespace smg
{

class LastCellReader;

/** Consecutive cells of a mesh stream. */
struct PieceCells
{
  std::int64_t first = 0, end = 0;
  std::int64_t firstVertex = 0; ///< that they introduce
};

/**
 * The cells around a piece of a .vsm file, in layers: those that share a vertex with a cell of the
 * piece, those that share one with these, and so on.
 *
 * A vertex is used only by cells from the block that introduces it up to its last cell. So a layer
 * takes the corners of the blocks between these two, for each vertex of the layer before that cells
 * elsewhere may use. In memory are the vertices and the cells that are found, and a block.
 */
class GhostCells
{
public:
  /** Finds `levels` layers around a piece, whose cells have these vertices, in ascending order. */
  GhostCells(VsmFile& file, LastCellReader& lastCells, const PieceCells& piece,
    std::vector<std::int64_t> vertices, int levels);

  /** Stream indices of the cells, ascending, and their corners. */
  const std::vector<std::int64_t>& cells() const { return this->Cells; }
  const std::vector<std::int64_t>& corners() const { return this->Corners; }

private:
  /** Adds the cells with any of the vertices; returns their other vertices. */
  std::vector<std::int64_t> addLayer(const std::vector<std::int64_t>& vertices);
  std::vector<std::int64_t> blocksWith(const std::vector<std::int64_t>& vertices);
  void sortCells();

  VsmFile& File;
  LastCellReader& LastCells;
  PieceCells Piece;
  std::size_t CornersOfCell;
  std::vector<std::int64_t> Cells, Corners;
};

} // namespace smg
