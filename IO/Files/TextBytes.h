// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

// How many characters TextOutput is expected to write, for estimates: numbers count with the blank
// or the end of the line after them.

/** Of a number below `count`, in the mean. */
inline double numberCharacters(std::int64_t count)
{
  // One of nine numbers is shorter than the longest, one of ninety by two digits ...
  return 1.9 + std::floor(std::log10(static_cast<double>(std::max<std::int64_t>(count, 1))));
}

/** Of a number with a fraction. The shortest text that reads back exactly has 7 to 9 digits, or 15
 * to 17; numbers from another text have fewer. */
inline double realCharacters(bool isDouble)
{
  return isDouble ? 17.5 : 10.0;
}

/** Of three coordinates. */
inline double positionCharacters(bool isDouble)
{
  return 3 * realCharacters(isDouble);
}

/** Of a tuple of column `column`, one of `columns`; none if it is negative: `otherwise`. */
inline double tupleCharacters(
  std::span<const ColumnSpec> columns, std::ptrdiff_t column, double otherwise = 0)
{
  if (column < 0)
  {
    return otherwise;
  }
  // Integers are colours, or the numbers of a few parts.
  constexpr double IntegerCharacters = 3;
  const ColumnSpec& spec = columns[static_cast<std::size_t>(column)];
  const bool isReal = spec.type == ScalarType::Float32 || spec.type == ScalarType::Float64;
  return spec.components *
         (isReal ? realCharacters(spec.type == ScalarType::Float64) : IntegerCharacters);
}

/** Of so many lines. */
inline std::int64_t textBytes(std::int64_t lines, double characters)
{
  return std::llround(static_cast<double>(lines) * characters);
}

} // namespace smg
