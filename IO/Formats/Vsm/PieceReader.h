// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/GhostCells.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Reads positions of vertices of any precision as double precision numbers. Throws Error if one is
 * not finite. */
class PositionReader
{
public:
  /** The positions are `column` of `table`. */
  explicit PositionReader(VsmFile& file, int table = VsmFormat::Vertices, int column = 0)
    : File(file)
    , Rows(file.Blocks, table, column)
  {
  }

  /** Reads the positions of the vertices [first, first + count). */
  void read(std::int64_t first, std::int64_t count, double* positions)
  {
    this->convert(count, positions, [&](std::byte* to) { this->Rows.read(first, count, to); });
  }

  /** Reads the positions of the vertices `vertices`, in ascending order. */
  void gather(std::span<const std::int64_t> vertices, double* positions)
  {
    this->convert(static_cast<std::int64_t>(vertices.size()), positions,
      [&](std::byte* to) { this->Rows.gather(vertices, to); });
  }

private:
  template <class Read>
  void convert(std::int64_t count, double* positions, Read read)
  {
    if (this->Rows.tupleBytes() == 3 * sizeof(double))
    {
      read(reinterpret_cast<std::byte*>(positions));
    }
    else
    {
      this->Floats.resize(3 * count);
      read(reinterpret_cast<std::byte*>(this->Floats.data()));
      std::copy(this->Floats.begin(), this->Floats.end(), positions);
    }
    std::int64_t wrong = 0; // without a branch a number
    for (std::int64_t i = 0; i < 3 * count; ++i)
    {
      wrong |= static_cast<std::int64_t>(!std::isfinite(positions[i]));
    }
    if (wrong != 0)
    {
      this->File.fail("has a position that is not finite; make it anew.");
    }
  }

  const VsmFile& File;
  RowReader Rows;
  std::vector<float> Floats;
};

/** Some vertices with all data for a piece. */
struct VertexRows
{
  std::vector<std::int64_t> ids; ///< ascending
  std::vector<double> positions;
  std::vector<std::int64_t> lastCells;
  std::vector<Column> columns;

  std::int64_t size() const { return static_cast<std::int64_t>(this->ids.size()); }
  /** Without rows, but with columns like `specs`. */
  void reset(const std::vector<ColumnSpec>& specs);
  /** Appends row `row` of `other`, which has the same columns. */
  void append(const VertexRows& other, std::int64_t row);
};

/** Reads the last cells of vertices. */
class LastCellReader
{
public:
  explicit LastCellReader(VsmFile& file)
    : File(&file)
  {
  }
  void read(std::int64_t first, std::span<std::int64_t> cells);
  void gather(std::span<const std::int64_t> vertices, std::int64_t* cells);

private:
  void load(std::int64_t vertex);

  VsmFile* File;
  std::int64_t First = 0; ///< vertex that Cells begins with
  std::vector<std::int64_t> Cells;
};

/** Reads vertices with some columns. */
class VertexReader
{
public:
  /** `columns`: numbers of the columns in the table of the vertices. */
  VertexReader(VsmFile& file, const std::vector<int>& columns);

  /** Appends the vertices [first, first + count) to `rows`. */
  void read(std::int64_t first, std::int64_t count, VertexRows& rows);
  /** Appends the vertices `vertices`, in ascending order, to `rows`. */
  void gather(std::span<const std::int64_t> vertices, VertexRows& rows);

private:
  /** Makes room for `count` more rows; returns the previous number of rows. */
  static std::int64_t grow(VertexRows& rows, std::int64_t count);

  PositionReader Positions;
  LastCellReader LastCells;
  std::vector<RowReader> Columns;
};

/** Reads pieces of a .vsm file. Stores the vertices of the pieces read so far that later cells use,
 * so that pieces in order read every block once. */
class PieceReader
{
public:
  PieceReader(VsmFile& file, const std::vector<std::string>& vertexColumns,
    const std::vector<std::string>& cellColumns);

  void read(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece);
  /** Adds so many layers of neighbours to a piece that was read. */
  void addGhosts(std::int64_t firstCell, std::int64_t endCell, int levels, MeshPiece& piece);

private:
  /** Fills the corners, as stream indices, and the columns of the cells. */
  void readCells(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece);
  /** The number of vertices that the cells before `cell` introduce. */
  std::int64_t introducedBefore(std::int64_t cell);
  const std::vector<std::int64_t>& cornersOfBlock(std::int64_t block);
  /** Fills Rows with the ghosts, which ascend, and the vertices [begin, end). */
  void collect(std::span<const std::int64_t> ghosts, std::int64_t begin, std::int64_t end);
  /** Adds cells in ascending order before and behind those of the piece, and all their vertices. */
  void addCells(const GhostCells& ghosts, MeshPiece& piece);
  /** Adds vertices, in ascending order, between those of the piece. */
  void addVertices(std::span<const std::int64_t> vertices, MeshPiece& piece);
  /** Keeps those of the old and the new vertices below `end` that outlive cell endCell - 1. */
  void remember(std::int64_t end, std::int64_t endCell);

  VsmFile& File;
  int Corners;
  std::vector<ColumnSpec> VertexSpecs, CellSpecs;
  VertexReader InOrder;  ///< for vertices that a piece introduces
  VertexReader Anywhere; ///< for older ones that are not stored
  std::vector<RowReader> CellColumns;
  LastCellReader LastCells; ///< for neighbours

  std::int64_t Block = -1; ///< block of the cells that BlockCorners are of
  std::vector<std::int64_t> BlockCorners;
  std::vector<std::int64_t> Ghosts, Missing;
  VertexRows Rows, Fetched, Alive, NextAlive;
};

} // namespace smg
