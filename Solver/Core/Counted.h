// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdint>
#include <iterator>
#include <string>

namespace smg
{

/** "1 point is", "7 points are": the number with the words for one or for several. */
inline std::string counted(std::int64_t number, const std::string& one, const std::string& several)
{
  return std::to_string(number) + ' ' + (number == 1 ? one : several);
}

/** The shortest text that reads back exactly, as of the same type. */
template <class Real>
std::string shortest(Real number)
{
  char text[64];
  return { text, std::to_chars(std::begin(text), std::end(text), number).ptr };
}

} // namespace smg
