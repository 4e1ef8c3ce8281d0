// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** Names of the columns that a conversion adds: places in the original file, from 0, int64. */
inline constexpr const char* OriginalIdName = "OriginalId";
inline const ColumnSpec OriginalIdSpec{ OriginalIdName, ScalarType::Int64, 1 };
inline constexpr const char* OriginalCellIdName = "OriginalCellId";
inline const ColumnSpec OriginalCellIdSpec{ OriginalCellIdName, ScalarType::Int64, 1 };

/** What a user calls a vertex or cell: by its original number, or by that in the stream. */
inline std::string nameOfRow(std::int64_t number, bool original)
{
  return std::to_string(number) + (original ? " of the mesh's file" : " of the stream");
}

/** The same of row `i` of a block that begins with row `first`: by its column of original numbers,
 * if it has that. */
inline std::string nameOfRow(
  const std::vector<Column>& columns, const ColumnSpec& numbers, std::int64_t first, std::size_t i)
{
  const std::ptrdiff_t place = findColumn(columns, numbers);
  return place < 0
           ? nameOfRow(first + static_cast<std::int64_t>(i), false)
           : nameOfRow(columns[static_cast<std::size_t>(place)].as<std::int64_t>()[i], true);
}

} // namespace smg
