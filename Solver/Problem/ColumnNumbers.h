// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cmath>

namespace smg
{

/** Whether a number of an integer column may have lost digits when it became this double: its
 * magnitude is 2^53 or more. */
inline bool isInexact(ScalarType type, double number)
{
  constexpr double LeastInexact = 9007199254740992.0;
  const bool isInteger = type != ScalarType::Float32 && type != ScalarType::Float64;
  return isInteger && std::fabs(number) >= LeastInexact;
}

/** What prevents a computation with this number of a column, as the end of "the column ..."; null:
 * nothing. */
inline const char* flawOf(ScalarType type, double number)
{
  return !std::isfinite(number) ? "is not a finite number"
         : isInexact(type, number)
           ? "has an integer of 2^53 or more, which double precision cannot hold exactly,"
           : nullptr;
}

} // namespace smg
