// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <string>
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

inline std::vector<std::string> columnNames(const std::vector<ColumnSpec>& specs)
{
  std::vector<std::string> names;
  for (const ColumnSpec& spec : specs)
  {
    names.push_back(spec.name);
  }
  return names;
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
