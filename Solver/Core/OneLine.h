// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg
{

/** The text without line breaks and other control characters, for an error message that quotes what
 * a file has. */
inline std::string oneLine(std::string text)
{
  for (char& c : text)
  {
    const auto code = static_cast<unsigned char>(c);
    c = c == '\n' || c == '\r' ? ' ' : code < 32 || code == 127 ? '?' : c;
  }
  return text;
}

} // namespace smg
