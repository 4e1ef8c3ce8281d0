// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <string_view>

namespace smg
{

/** What Microsoft's libraries write for numbers that are not finite, such as 1.#QNAN, -1.#IND and
 * 1.#INF000; none for other words. */
inline std::optional<double> parseMicrosoft(std::string_view word)
{
  const bool isNegative = word.starts_with('-');
  word.remove_prefix(isNegative || word.starts_with('+') ? 1 : 0);
  constexpr std::string_view Begin = "1.#";
  if (!word.starts_with(Begin))
  {
    return {};
  }
  word.remove_prefix(Begin.size());
  word = word.substr(0, word.find_last_not_of('0') + 1);
  if (word == "INF")
  {
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    return isNegative ? -Infinity : Infinity;
  }
  return word == "QNAN" || word == "SNAN" || word == "IND"
           ? std::optional(std::numeric_limits<double>::quiet_NaN())
           : std::nullopt;
}

} // namespace smg
