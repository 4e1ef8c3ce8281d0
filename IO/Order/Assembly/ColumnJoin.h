// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/RowTable.h"
#include "IO/Import/RawMesh.h"
#include "smg/Column.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** Reorders the columns of a file for a stream: put() sets the number in the file of each row of
 * the stream, row by row; fill() delivers the tuples of the rows. Numbers may be repeated. */
class ColumnJoin
{
public:
  /** The columns must outlive this object. Uses about `memory` bytes of the pool, twice that in
   * join(). */
  ColumnJoin(Workspace& workspace, const std::vector<RawColumn>& columns, std::int64_t memory);

  /** Sets the number of the next row. */
  void put(std::uint32_t number) { this->Numbers.put({ number, this->NextRow++ }); }

  /** Sorts the tuples by rows, after the last put(). */
  void join();

  /** Fills the first columns of `columns` with the tuples of the next `rows` rows. */
  void fill(std::int64_t rows, std::vector<Column>& columns);

private:
  struct Pair
  {
    std::uint32_t number;
    std::uint32_t row;
    auto operator<=>(const Pair&) const = default;
  };

  const std::vector<RawColumn>& Columns;
  std::uint32_t NextRow = 0;
  ExternalSort<Pair> Numbers;
  std::optional<RowTable> Rows;
  std::int64_t Filled = 0; ///< rows
  Workspace& Space;
  std::int64_t Memory;
};

} // namespace smg
