// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace smg
{

/** Collects rows of some columns until they fill a block. */
class RowBuffer
{
public:
  explicit RowBuffer(const std::vector<ColumnSpec>& columns)
    : Bytes(columns.size())
  {
    for (const ColumnSpec& column : columns)
    {
      this->TupleBytes.push_back(column.tupleBytes());
    }
  }

  /** Appends `count` rows of the columns `values`, from row `first` on. */
  void append(const std::vector<Column>& values, std::int64_t first, std::int64_t count)
  {
    for (std::size_t c = 0; c < this->Bytes.size(); c++)
    {
      const auto from = values[c].bytes.begin() + first * this->TupleBytes[c];
      this->Bytes[c].insert(this->Bytes[c].end(), from, from + count * this->TupleBytes[c]);
    }
  }

  /** The columns of a block: `first`, then the collected ones. Valid until rows are appended. */
  std::span<const std::span<const std::byte>> block(
    std::initializer_list<std::span<const std::byte>> first)
  {
    this->Spans.assign(first);
    this->Spans.insert(this->Spans.end(), this->Bytes.begin(), this->Bytes.end());
    return this->Spans;
  }

  void clear()
  {
    for (auto& bytes : this->Bytes)
    {
      bytes.clear();
    }
  }

private:
  std::vector<std::size_t> TupleBytes;
  std::vector<std::vector<std::byte>> Bytes;
  std::vector<std::span<const std::byte>> Spans;
};

} // namespace smg
