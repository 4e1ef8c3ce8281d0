// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** A name for a vertex or cell in messages, by its index in the original file or in the stream. */
inline std::string nameOfRow(std::int64_t number, bool original)
{
  return std::to_string(number) + (original ? " of the mesh's file" : " of the stream");
}

/** The same for row `i` of a block that begins with row `first`: by its column of original indices,
 * if any. */
inline std::string nameOfRow(
  const std::vector<Column>& columns, const ColumnSpec& numbers, std::int64_t first, std::size_t i)
{
  const std::ptrdiff_t place = findColumn(columns, numbers);
  return place < 0
           ? nameOfRow(first + static_cast<std::int64_t>(i), false)
           : nameOfRow(columns[static_cast<std::size_t>(place)].as<std::int64_t>()[i], true);
}

} // namespace smg
