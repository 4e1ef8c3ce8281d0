// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/PositionReader.h"
#include "IO/Formats/Vsm/VsmFile.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

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

} // namespace smg
