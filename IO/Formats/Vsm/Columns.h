// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <vector>

namespace smg
{

/** A column without values for each of the specs, with room for this many tuples. */
inline std::vector<Column> emptyColumns(
  const std::vector<ColumnSpec>& specs, std::size_t tuples = 0)
{
  std::vector<Column> columns;
  for (const ColumnSpec& spec : specs)
  {
    columns.push_back({ spec, {} });
    columns.back().bytes.reserve(spec.tupleBytes() * tuples);
  }
  return columns;
}

/** Removes all tuples, but keeps the memory. */
inline void clearTuples(std::vector<Column>& columns)
{
  for (Column& column : columns)
  {
    column.bytes.clear();
  }
}

} // namespace smg
