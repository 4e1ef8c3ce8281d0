// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"

namespace smg
{

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t Most = 32;
  std::string result = "'";
  for (const char c : text.substr(0, Most))
  {
    result += c >= 32 && c < 127 ? c : '?';
  }
  return result + (text.size() > Most ? "...'" : "'");
}

} // namespace smg
