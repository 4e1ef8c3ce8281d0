// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/ColumnJoin.h"

#include <algorithm>
#include <cstring>

namespace smg
{

ColumnJoin::ColumnJoin(
  Workspace& workspace, const std::vector<RawColumn>& columns, std::int64_t memory)
  : Columns(columns)
  , Numbers(workspace, memory)
  , Space(workspace)
  , Memory(memory)
{
}

void ColumnJoin::join()
{
  std::size_t rowBytes = 0;
  std::vector<BucketFile::Reader> readers = readersOf(this->Columns, this->Space.available() / 4);
  for (const RawColumn& column : this->Columns)
  {
    rowBytes += column.spec.tupleBytes();
  }
  this->Rows.emplace(this->Space, this->NextRow, rowBytes, this->Memory * 3 / 4);
  this->Numbers.sort();
  const Buffer row(this->Space.pool(), rowBytes);
  std::int64_t read = -1; // the number whose tuples are in `row`
  for (Pair pair; this->Numbers.next(pair);)
  {
    for (; read < pair.number; ++read)
    {
      std::size_t at = 0;
      for (std::size_t c = 0; c < readers.size(); ++c)
      {
        const std::size_t bytes = this->Columns[c].spec.tupleBytes();
        readers[c].read(row.bytes().subspan(at, bytes));
        at += bytes;
      }
    }
    this->Rows->put(pair.row, row.bytes());
  }
  this->Rows->close();
}

void ColumnJoin::fill(std::int64_t rows, std::vector<Column>& columns)
{
  for (std::size_t c = 0; c < this->Columns.size(); ++c)
  {
    columns[c].spec = this->Columns[c].spec;
    columns[c].resize(static_cast<std::size_t>(rows));
  }
  for (std::size_t done = 0; done < static_cast<std::size_t>(rows);)
  {
    const std::span<const std::byte> bytes =
      this->Rows->read(this->Filled, rows - static_cast<std::int64_t>(done));
    const std::size_t count = bytes.size() / this->Rows->rowBytes();
    std::size_t at = 0;
    for (std::size_t c = 0; c < this->Columns.size(); ++c)
    {
      const std::size_t tuple = this->Columns[c].spec.tupleBytes();
      std::byte* to = columns[c].bytes.data() + done * tuple;
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(to + i * tuple, bytes.data() + i * this->Rows->rowBytes() + at, tuple);
      }
      at += tuple;
    }
    done += count;
    this->Filled += static_cast<std::int64_t>(count);
  }
}

} // namespace smg
