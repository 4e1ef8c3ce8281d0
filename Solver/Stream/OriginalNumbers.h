// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

#include <cstdint>
#include <string>

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

} // namespace smg
