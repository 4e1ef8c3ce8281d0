// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"

#include "Solver/Core/Text.h"

namespace smg
{

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t Most = 200;
  std::string result = "'";
  while (!text.empty() && result.size() <= Most)
  {
    const std::size_t length = std::max<std::size_t>(utf8Bytes(text), 1);
    result += replaced(text.substr(0, length), "?",
      [](std::string_view character) { return !isControl(character); });
    text.remove_prefix(length);
  }
  return result + (text.empty() ? "'" : "...'");
}

} // namespace smg
