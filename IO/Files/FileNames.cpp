// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"

namespace smg
{

namespace
{

/** The bytes of the printable character in UTF-8 with which the text begins; 0: there is none. */
std::size_t characterBytes(std::string_view text)
{
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80)
  {
    return first >= 32 && first < 127 ? 1 : 0;
  }
  // Neither overlong ones nor the controls C1, which begin with 0xc2 and a byte below 0xa0.
  const std::size_t bytes = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (bytes == 0 || first > 0xf4 || text.size() < bytes)
  {
    return 0;
  }
  const auto second = static_cast<unsigned char>(text[1]);
  const bool isBad = (first == 0xc2 && second < 0xa0) || (first == 0xe0 && second < 0xa0) ||
                     (first == 0xed && second >= 0xa0) || (first == 0xf0 && second < 0x90) ||
                     (first == 0xf4 && second >= 0x90);
  const bool continues = std::ranges::all_of(text.substr(1, bytes - 1),
    [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; });
  return !isBad && continues ? bytes : 0;
}

} // namespace

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t Most = 200;
  std::string result = "'";
  std::size_t at = 0;
  while (at < text.size() && result.size() <= Most)
  {
    const std::size_t length = characterBytes(text.substr(at));
    if (length > 0)
    {
      result += text.substr(at, length);
    }
    else
    {
      result += '?';
    }
    at += std::max<std::size_t>(length, 1);
  }
  return result + (at < text.size() ? "...'" : "'");
}

} // namespace smg
