// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** A stretch of consecutive cells of a mesh stream with all the vertices that these cells use. */
struct MeshPiece
{
  std::int64_t firstCell = 0;          ///< stream index of the piece's first cell
  std::vector<std::int64_t> ids;       ///< stream indices of the vertices, ascending
  std::vector<double> positions;       ///< x, y, z of each vertex
  std::vector<float> normals;          ///< x, y, z of each; of previews, else empty
  std::vector<std::uint8_t> ghost;     ///< 1: introduced by a cell before the piece
  std::vector<std::uint8_t> finalized; ///< 1: no cell after the piece uses the vertex
  std::vector<std::int64_t> corners;   ///< places in `ids`, cornersOf(cellType) a cell
  std::vector<Column> vertexColumns;   ///< a tuple a vertex
  std::vector<Column> cellColumns;     ///< a tuple a cell

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->ids.size()); }
};

} // namespace smg
