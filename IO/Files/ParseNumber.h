// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fast_float/fast_float.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace smg
{

/** The parsers do not accept a leading plus sign, which occurs in files. */
inline const char* afterPlus(std::string_view word)
{
  return word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
}

/** A whole word as an integer, if it is one of 64 bits. */
inline std::optional<std::int64_t> parseInteger(std::string_view word)
{
  const char* end = word.data() + word.size();
  std::int64_t value = 0;
  const auto result = std::from_chars(afterPlus(word), end, value);
  return !word.empty() && result.ec == std::errc() && result.ptr == end ? std::optional(value)
                                                                        : std::nullopt;
}

/** A whole word as a finite number, if it is one. */
inline std::optional<double> parseFinite(std::string_view word)
{
  const char* end = word.data() + word.size();
  double value = 0.0;
  const auto result = fast_float::from_chars(afterPlus(word), end, value);
  const bool isNumber = !word.empty() && result.ec == std::errc() && result.ptr == end;
  return isNumber && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace smg
