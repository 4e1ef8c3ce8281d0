// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace smg
{

/** A finite real number as Fortran writes it: the exponent may begin with D, or with its sign, as
 * in 1.5D-3 and 1.5-3. */
inline std::optional<double> parseFortran(std::string_view word)
{
  if (const std::optional<double> number = parseFinite(word))
  {
    return number;
  }
  constexpr std::size_t Longest = 64;
  std::array<char, Longest + 1> text{};
  std::size_t size = 0;
  bool hasExponent = false;
  for (std::size_t i = 0; i < word.size() && size < Longest; ++i)
  {
    const char c = word[i];
    const bool isLetter = c == 'd' || c == 'D' || c == 'e' || c == 'E';
    const bool isSign = (c == '+' || c == '-') && i > 0 && !hasExponent;
    if (isSign)
    {
      text[size++] = 'e';
    }
    hasExponent = hasExponent || isLetter || isSign;
    text[size++] = isLetter ? 'e' : c;
  }
  return size < Longest ? parseFinite({ text.data(), size }) : std::nullopt;
}

} // namespace smg
