// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** The rows of the vertices, or of the cells, of a mesh stream in their original order. */
struct OriginalRows
{
  std::int64_t count = 0;          ///< number of rows
  std::string column;              ///< the int64 column that says the rows; empty: none
  std::vector<std::int64_t> table; ///< without a column: by stream index; empty: that is the row

  /** The column, if there is one: to be read with those whose rows are wanted. */
  std::vector<std::string> columns() const
  {
    return this->column.empty() ? std::vector<std::string>{} : std::vector{ this->column };
  }
  /** That column among those that were read; null: there is none. */
  const Column* numbersIn(const std::vector<Column>& columns) const
  {
    const auto found = std::ranges::find(columns, this->column,
      [](const Column& read) -> const std::string& { return read.spec.name; });
    return this->column.empty() || found == columns.end() ? nullptr : &*found;
  }
  /** Appends the rows of the vertices of a block that was read with columns(). */
  void append(const MeshBlock& block, std::vector<std::int64_t>& rows) const
  {
    const Column* const numbers = this->numbersIn(block.vertexColumns);
    for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
    {
      rows.push_back(this->row(block.firstVertex, numbers, i));
    }
  }
  /** The row of tuple `i` of a block whose first one has the stream index `first`. `numbers`: the
   * column of the block; null if there is none. */
  std::int64_t row(std::int64_t first, const Column* numbers, std::size_t i) const
  {
    if (numbers)
    {
      return numbers->as<std::int64_t>()[i];
    }
    const std::int64_t index = first + static_cast<std::int64_t>(i);
    return this->table.empty() ? index : this->table[static_cast<std::size_t>(index)];
  }
};

/**
 * The number of cells of the file or arrays of which the cells of a mesh are parts: of different
 * numbers in OriginalCellId. Elements that are no cells of the mesh, as those of groups of facets,
 * do not count. Without this column it is the number of the cells. Works out of core.
 * @param conversion that has made the mesh; null: not known. The column is read unless it tells.
 * @throws Error if the file cannot be read; Cancelled
 */
SMG_EXPORT std::int64_t countElements(const StoredMesh& mesh,
  const ConversionReport* conversion = nullptr, const ProgressFunction& progress = {});

/** A point of the file that was merged with another one, and that one: rows of vertices. */
struct MergedRow
{
  std::int64_t row, kept;
};

/**
 * The original order of a mesh, in which arrays have a row for each vertex or cell: that of the
 * file or of the arrays it was made of, by the columns OriginalId and OriginalCellId.
 *
 * Vertices include those of no cell, and points that were merged with others. Triangles or
 * tetrahedra that were a single cell of the file follow each other, in stream order, and nothing
 * stands for cells that were left out. Where a column is missing, or has other numbers than 0, 1,
 * ... (as that of a simplified surface, which names vertices of another mesh, or of a file whose
 * points were merged before), the order is that of the stream, before the vertices of no cell.
 */
class SMG_EXPORT OriginalOrder
{
public:
  /**
   * Reads the numbers, unless the conversion tells all of them.
   * @param mesh a mesh with a StoredMesh::file()
   * @param conversion that has made the mesh; null: not known
   * @param weld ConversionOptions::weld of that
   * @throws Error if the file cannot be read; Cancelled
   */
  explicit OriginalOrder(const StoredMesh& mesh, const ConversionReport* conversion = nullptr,
    const ProgressFunction& progress = {}, std::optional<double> weld = {});

  /** The number of vertices in the original order, for which nothing is read but the header. */
  static std::int64_t countVertices(const StoredMesh& mesh);

  /** The points that the conversion has merged with a vertex of the mesh. */
  const std::vector<MergedRow>& merged() const { return this->Merged; }

  const OriginalRows& vertices() const { return this->Vertices; }
  const OriginalRows& cells() const { return this->Cells; }
  /** The row of vertex `number` of those of no cell, in the order of the file, whose place is `id`.
   */
  std::int64_t isolatedRow(std::int64_t number, std::int64_t id) const
  {
    return this->Vertices.column.empty() ? this->StreamVertices + number : id;
  }

private:
  void readVertices(const StoredMesh& mesh, const ProgressFunction& progress);
  void readCells(const StoredMesh& mesh, const ProgressFunction& progress);
  void findMerged(const StoredMesh& mesh, double weld, const ProgressFunction& progress);

  OriginalRows Vertices, Cells;
  std::vector<MergedRow> Merged;
  std::int64_t StreamVertices = 0;
};

} // namespace smg
