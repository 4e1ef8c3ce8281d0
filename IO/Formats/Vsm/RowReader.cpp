// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/RowReader.h"

#include <algorithm>
#include <cstring>

namespace smg
{

RowReader::RowReader(BlockFileReader& file, int table, int column)
  : File(&file)
  , Table(table)
  , Column(column)
  , TupleBytes(file.tables()[table].columns[column].tupleBytes())
{
}

void RowReader::load(std::int64_t block)
{
  if (block != this->Block)
  {
    this->Block = -1;
    this->Bytes.resize(this->File->columnBytes(this->Table, block, this->Column));
    this->File->read(this->Table, block, this->Column, this->Bytes);
    this->Block = block;
  }
}

void RowReader::read(std::int64_t first, std::int64_t count, std::byte* values)
{
  while (count > 0)
  {
    const std::int64_t block = this->File->blockOf(this->Table, first);
    this->load(block);
    const std::int64_t begin = first - this->File->firstRow(this->Table, block);
    const std::int64_t n = std::min(count, this->File->blockRows(this->Table, block) - begin);
    std::memcpy(values, this->Bytes.data() + begin * this->TupleBytes, n * this->TupleBytes);
    values += n * this->TupleBytes;
    first += n;
    count -= n;
  }
}

void RowReader::gather(std::span<const std::int64_t> rows, std::byte* values)
{
  std::int64_t begin = 0;
  std::int64_t end = 0;
  for (const std::int64_t row : rows)
  {
    if (row < begin || row >= end)
    {
      const std::int64_t block = this->File->blockOf(this->Table, row);
      this->load(block);
      begin = this->File->firstRow(this->Table, block);
      end = begin + this->File->blockRows(this->Table, block);
    }
    std::memcpy(values, this->Bytes.data() + (row - begin) * this->TupleBytes, this->TupleBytes);
    values += this->TupleBytes;
  }
}

} // namespace smg
