// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

namespace smg
{

/** Names of the columns that a conversion adds: places in the original file, from 0, int64. */
inline constexpr const char* OriginalIdName = "OriginalId";
inline const ColumnSpec OriginalIdSpec{ OriginalIdName, ScalarType::Int64, 1 };
inline constexpr const char* OriginalCellIdName = "OriginalCellId";
inline const ColumnSpec OriginalCellIdSpec{ OriginalCellIdName, ScalarType::Int64, 1 };

} // namespace smg
