// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace smg
{

/** The doubles that an arithmetic type can hold when they are rounded: from `low` to below `end`.
 * The largest number of a 64-bit type is not a double, but the one after it is. */
struct RoundedRange
{
  double low = -HUGE_VAL, end = HUGE_VAL;

  template <class T>
  static RoundedRange of()
  {
    if constexpr (std::is_floating_point_v<T>)
    {
      return {};
    }
    else
    {
      return { static_cast<double>(std::numeric_limits<T>::min()),
        std::ldexp(1.0, std::numeric_limits<T>::digits) };
    }
  }

  bool contains(double value) const { return value >= this->low && value < this->end; }
};

/** Converts a value to a type. For integer types it is rounded, and clipped to the range of the
 * type. */
template <class T>
T rounded(double value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return static_cast<T>(value);
  }
  else
  {
    const RoundedRange range = RoundedRange::of<T>();
    const double nearest = std::nearbyint(value);
    if (range.contains(nearest))
    {
      return static_cast<T>(nearest);
    }
    return nearest < range.low ? std::numeric_limits<T>::min() : std::numeric_limits<T>::max();
  }
}

} // namespace smg
