// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Reads rows of a column of a block file, independent of its blocks. Keeps the last block, so that
 * rows in ascending order read each block once. */
class RowReader
{
public:
  RowReader(BlockFileReader& file, int table, int column);

  std::size_t tupleBytes() const { return this->TupleBytes; }

  /** Reads the rows [first, first + count). */
  void read(std::int64_t first, std::int64_t count, std::byte* values);
  /** Reads the rows `rows`, in ascending order. */
  void gather(std::span<const std::int64_t> rows, std::byte* values);

private:
  void load(std::int64_t block);

  BlockFileReader* File;
  int Table, Column;
  std::size_t TupleBytes;
  std::int64_t Block = -1;
  std::vector<std::byte> Bytes; ///< of that block
};

} // namespace smg
