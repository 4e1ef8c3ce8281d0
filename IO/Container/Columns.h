// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

#include <cstddef>
#include <cstring>
#include <vector>

namespace smg
{

/** A column without values for each of the specs, with room for so many tuples. */
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

/** Makes `to` the tuples `rows` of `from`, in the rows' order; the rows are any integers. */
template <class Rows>
void gatherTuples(const Column& from, const Rows& rows, Column& to)
{
  const std::size_t bytes = from.spec.tupleBytes();
  to.spec = from.spec;
  to.resize(rows.size());
  std::byte* at = to.bytes.data();
  for (const auto row : rows)
  {
    std::memcpy(at, from.bytes.data() + static_cast<std::size_t>(row) * bytes, bytes);
    at += bytes;
  }
}

} // namespace smg
