// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"
#include "Solver/Stream/MeshSource.h"

#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** A mesh in memory as its file has it: any vertex order, any cell order, isolated vertices. */
struct IndexedMesh
{
  CellType cellType = CellType::Triangle;
  /** Whether the coordinates were double precision numbers in the file. */
  bool doublePositions = true;
  std::vector<double> positions;     ///< x, y, z a vertex, finite
  std::vector<std::int64_t> corners; ///< cornersOf(cellType) a cell, each a vertex of the mesh
  /** The place in the file, from 0, of the face or element a cell came from; empty: cell c is c. */
  std::vector<std::int64_t> originalCells;
  std::vector<Column> vertexColumns; ///< a tuple a vertex
  std::vector<Column> cellColumns;   ///< a tuple a cell
  /** Polygons and strips of the file that became several triangles. */
  std::int64_t triangulatedPolygons = 0;
  /** Points, lines, and surface cells beside tetrahedra, that were left out. */
  std::int64_t droppedCells = 0;
  /** Names of columns that were left out, since their names are reserved. */
  std::vector<std::string> droppedColumns;

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->positions.size() / 3); }
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->corners.size()) / cornersOf(this->cellType);
  }
};

} // namespace smg
