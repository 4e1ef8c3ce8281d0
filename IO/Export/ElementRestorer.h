// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/ColumnRows.h"
#include "IO/Export/FanChain.h"
#include "IO/Export/RestoredChunks.h"
#include "IO/External/RowSort.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * Restores the elements of the original file, in its order, from the cells of a mesh stream, out of
 * core: put() all cells, then restore(), then next() delivers the elements. Triangles of one
 * element that are the fan of a polygon become this polygon; other cells of one element keep their
 * order.
 */
class ElementRestorer
{
public:
  /** For cells of info.cellType with info.elementColumns. Uses `memory` bytes of the workspace. */
  ElementRestorer(Workspace& workspace, std::int64_t memory, const RestoredInfo& info);

  /** Adds a cell with tuple `tuple` of the columns, which begin with those of the info. */
  void put(std::int64_t element, std::span<const std::uint32_t> corners,
    const std::vector<Column>& columns, std::size_t tuple);

  /** To be called after the last put(); sets the counts of elements and corners in `info`. Throws
   * Error. */
  void restore(RestoredInfo& info);

  /** Notes on elements that restore() could not restore, a sentence each. */
  std::vector<std::string> notes() const;

  /** The next elements; returns false at the end. */
  bool next(RestoredElements& elements);
  /** Goes back to the first element. */
  void rewind() { this->Reader.reset(); }

private:
  void take(const RowSort::Row& row);
  void endGroup();
  void writeCells();
  void write(std::span<const std::uint32_t> corners, std::span<const std::byte> tuples);

  Workspace& Space;
  std::size_t CornersOfCell;
  ColumnRows Columns;
  RowSort Sorted;      ///< a row is the corners, then the columns
  BucketFile Elements; ///< number of corners, corners, columns
  RestoredInfo Counts;
  std::size_t MostCells; ///< of an element that is processed as a whole

  // The cells of one element.
  std::uint64_t Element = UINT64_MAX; ///< none, at first
  std::vector<std::uint32_t> Corners;
  std::vector<std::byte> Tuples; ///< of all columns, cell by cell
  bool TooLarge = false;
  bool MayBeFan = false;  ///< all its cells are triangles that begin with
  std::uint32_t Apex = 0; ///< this corner
  FanChain Fan;
  std::int64_t Split = 0, Large = 0, Different = 0; ///< elements of that kind

  std::optional<BucketFile::Reader> Reader;
  std::int64_t Next = 0;
};

} // namespace smg
