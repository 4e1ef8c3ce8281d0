// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/RowTable.h"
#include "IO/Raw/RawMesh.h"
#include "smg/Column.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * Brings the columns of a file, whose tuples are known by their numbers in it, into the order of a
 * stream: put() says which number each row of the stream has, one row after the other; fill()
 * delivers the tuples of the rows. A number may come any number of times.
 */
class ColumnJoin
{
public:
  /** The columns must outlive it. Uses about `memory` bytes of the pool, twice that in join(). */
  ColumnJoin(Workspace& workspace, const std::vector<RawColumn>& columns, std::int64_t memory);

  /** The number of the next row. */
  void put(std::uint32_t number) { this->Numbers.put({ number, this->NextRow++ }); }

  /** Brings the tuples into the order of the rows, after the last put(). */
  void join();

  /** Puts the tuples of the next `rows` rows into the first columns of `columns`. */
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
