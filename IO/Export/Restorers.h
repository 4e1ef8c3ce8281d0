// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/TriangleChains.h"
#include "IO/External/ExternalSort.h"
#include "IO/Mesh/Columns.h"
#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** The layout of a row with the tuples of some columns for one vertex or cell. */
class ColumnRows
{
public:
  explicit ColumnRows(std::vector<ColumnSpec> specs)
    : Specs(std::move(specs))
  {
    for (const ColumnSpec& spec : this->Specs)
    {
      this->RowBytes += spec.tupleBytes();
    }
  }

  const std::vector<ColumnSpec>& specs() const { return this->Specs; }
  /** Bytes of a row. */
  std::size_t bytes() const { return this->RowBytes; }

  /** Fills a row with tuple `tuple` of the columns; additional columns are ignored. */
  void gather(const std::vector<Column>& columns, std::size_t tuple, std::byte* row) const
  {
    for (std::size_t c = 0; c < this->Specs.size(); ++c)
    {
      const std::size_t size = this->Specs[c].tupleBytes();
      std::memcpy(row, columns[c].bytes.data() + tuple * size, size);
      row += size;
    }
  }

  /** Appends the tuples of a row to the columns, which correspond to the specs. */
  void append(const std::byte* row, std::vector<Column>& columns) const
  {
    for (std::size_t c = 0; c < this->Specs.size(); ++c)
    {
      const std::size_t size = this->Specs[c].tupleBytes();
      columns[c].bytes.insert(columns[c].bytes.end(), row, row + size);
      row += size;
    }
  }

private:
  std::vector<ColumnSpec> Specs;
  std::size_t RowBytes = 0;
};

/**
 * Restores the elements of the original file, in its order, from the cells of a mesh stream, out of
 * core: put() all cells, then restore(), then next() delivers the elements. Triangles of one
 * element that are those of a polygon become this polygon; those of a strip are written along it;
 * other cells of one element stay as they are, in their order.
 */
class ElementRestorer
{
public:
  /** For cells of info.cellType with info.elementColumns. Uses `memory` bytes of the workspace. Of
   * polygons with more than `maxCorners` corners, those that are no fan stay triangles, since the
   * writer would make them one. */
  ElementRestorer(
    Workspace& workspace, std::int64_t memory, const MeshFileInfo& info, std::int64_t maxCorners);

  /** Adds a cell with tuple `tuple` of the columns, the first of which are the columns of the
   * info. */
  void put(std::int64_t element, std::span<const std::uint32_t> corners,
    const std::vector<Column>& columns, std::size_t tuple);

  /** To be called after the last put(); sets the counts of elements and corners in `info`. Throws
   * Error. */
  void restore(MeshFileInfo& info);

  /** Notes on elements that restore() could not restore, a sentence each. */
  std::vector<std::string> notes() const;

  /** The next elements; returns false at the end. */
  bool next(ElementChunk& elements);
  /** Goes back to the first element. */
  void rewind() { this->Reader.reset(); }

private:
  void take(const RowSort::Row& row);
  bool hasGroupedFacets() const;
  void writePolygon(bool isFan);
  void writeInOrder(std::span<const std::uint32_t> cells);
  void endGroup();
  void writeCells();
  void writeCell(std::size_t cell);
  void write(std::span<const std::uint32_t> corners, std::span<const std::byte> tuples);

  Workspace& Space;
  std::size_t CornersOfCell;
  ColumnRows Columns;
  RowSort Sorted;      ///< a row is the corners, then the columns
  BucketFile Elements; ///< number of corners, corners, columns
  MeshFileInfo Counts;
  std::int64_t MaxCorners;
  std::size_t MaxCells; ///< of an element that is processed as a whole

  // The cells of one element.
  std::uint64_t Element = UINT64_MAX; ///< none, at first
  std::vector<std::uint32_t> Corners;
  std::vector<std::byte> Tuples; ///< of all columns, cell by cell
  bool TooLarge = false;
  bool MayBeFan = false;  ///< all its cells are triangles that begin with
  std::uint32_t Apex = 0; ///< this corner
  FanChain Fan;
  PolygonTree Tree;
  StripChain Strip;
  std::ptrdiff_t FacetGroups = -1; ///< place of this column in a row; -1: there is none
  std::int64_t Split = 0, Large = 0, Different = 0, Grouped = 0; ///< elements of that kind

  std::optional<BucketFile::Reader> Reader;
  std::int64_t Next = 0;
};

/** Sorts vertices by their original numbers, out of core: put() all, then sort(), then next()
 * delivers them. The numbers must be 0, 1, 2 ..., with one vertex each. */
class VertexRestorer
{
public:
  /** For info.vertices vertices with info.vertexColumns. Uses `memory` bytes of the workspace.
   * `name` is the name of the mesh in errors. */
  VertexRestorer(
    Workspace& workspace, std::int64_t memory, const MeshFileInfo& info, std::string name);

  /** Adds vertices with these numbers. The first columns are the columns of the info. Throws Error
   * if a number is out of range. */
  void put(std::span<const std::int64_t> ids, std::span<const double> positions,
    const std::vector<Column>& columns);

  /** To be called after the last put(). */
  void sort() { this->Sorted.sort(); }

  /** The next vertices; returns false at the end. Throws Error if no vertex, or more than one, has
   * a number. */
  bool next(VertexChunk& vertices);

private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string Name;
  FilePositions Positions;
  ColumnRows Columns;
  std::int64_t Count;
  std::int64_t Chunk; ///< vertices delivered at once
  std::int64_t Next = 0;
  RowSort Sorted;               ///< a row is a position, then the columns
  std::vector<std::byte> Bytes; ///< of the positions delivered at once
};

} // namespace smg
