// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

namespace smg
{

/** A whole number that a user has set as a property, and what it may be. */
struct PropertyRange
{
  static constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

  const char* property;
  std::int64_t value;
  std::int64_t least;
  std::int64_t most = NoLimit;
  const char* other = ""; ///< another value, in words, that has been allowed: as "0 (automatic)"
};

/** Throws Error, which names the property, if a number is out of its range. Setters do not clamp: a
 * user would have another number than was set, without a word. */
inline void requireInRange(std::initializer_list<PropertyRange> numbers)
{
  for (const PropertyRange& number : numbers)
  {
    if (number.value < number.least || number.value > number.most)
    {
      throw Error(
        std::string(number.property) + " is " + std::to_string(number.value) + ": set it to " +
        (number.most == PropertyRange::NoLimit ? "at least " + std::to_string(number.least)
                                               : "a number from " + std::to_string(number.least) +
                                                   " to " + groupedDigits(number.most)) +
        (*number.other ? std::string(", or to ") + number.other : "") + '.');
    }
  }
}

/** The same for a number with a fraction, which is also to be finite. */
struct RealPropertyRange
{
  static constexpr double NoLimit = HUGE_VAL;

  const char* property;
  double value;
  double least = -NoLimit;
  double most = NoLimit;
  bool isOpen = false; ///< whether the ends do not belong to it
  const char* other = "";
};

/** Throws Error as above. */
inline void requireInRealRange(std::initializer_list<RealPropertyRange> numbers)
{
  for (const RealPropertyRange& number : numbers)
  {
    const auto& [property, value, least, most, isOpen, other] = number;
    const bool isIn = std::isfinite(value) &&
                      (isOpen ? value > least && value < most : value >= least && value <= most);
    if (isIn)
    {
      continue;
    }
    const bool hasLeast = std::isfinite(least), hasMost = std::isfinite(most);
    std::string range = "a finite number";
    if (hasLeast && hasMost)
    {
      range = "a number from " + shortest(least) + " to " + shortest(most) +
              (isOpen ? ", both excluded" : "");
    }
    else if (hasLeast)
    {
      range = (isOpen ? "a number greater than " : "at least ") + shortest(least);
    }
    throw Error(std::string(property) + " is " + shortest(value) + ": set it to " + range +
                (*other ? std::string(", or to ") + other : "") + '.');
  }
}

/** What to print for one of the values of an enumeration; the number, if it is another. */
template <std::size_t Count>
std::string printedChoice(const char* const (&names)[Count], int value)
{
  const bool isOne = value >= 0 && static_cast<std::size_t>(value) < Count;
  return isOne ? names[value] : std::to_string(value);
}

} // namespace smg
