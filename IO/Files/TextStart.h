// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"

#include <algorithm>
#include <string_view>

namespace smg
{

// Functions to detect text formats by their first bytes.

inline constexpr std::string_view Blanks = " \t\r\f\v\n";

inline bool isBlank(char c)
{
  return Blanks.find(c) != std::string_view::npos;
}

/** The text without a byte order mark. */
inline std::string_view withoutMark(std::string_view text)
{
  return text.substr(text.starts_with(ByteOrderMark) ? ByteOrderMark.size() : 0);
}

/** The text from its first non-blank character on. */
inline std::string_view trimmed(std::string_view text)
{
  return text.substr(std::min(text.find_first_not_of(Blanks), text.size()));
}

/** The text without byte order mark, from its first non-blank character on. */
inline std::string_view textStart(std::string_view bytes)
{
  return trimmed(withoutMark(bytes));
}

/** The same from the first line on that is not a comment (beginning with #). */
inline std::string_view textAfterComments(std::string_view bytes)
{
  std::string_view text = textStart(bytes);
  while (text.starts_with('#'))
  {
    text = trimmed(text.substr(std::min(text.find('\n'), text.size())));
  }
  return text;
}

} // namespace smg
