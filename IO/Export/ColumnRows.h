// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <cstring>
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

} // namespace smg
