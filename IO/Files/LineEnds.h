// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace smg
{

/** The characters that end lines: LF, CR LF, or CR alone as of old Macintosh systems. */
inline constexpr std::string_view LineEnds = "\r\n";

/** The character that ends the lines of a text: CR if it has more CR without a LF after them than
 * LF, so that neither a few CR within lines nor binary data behind a header mislead. */
inline char lineEndOf(std::string_view text)
{
  std::ptrdiff_t excess = 0; // of such CR over LF
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const auto byte = static_cast<unsigned char>(text[at]);
    if (byte == '\n')
    {
      --excess;
    }
    else if (byte == '\r')
    {
      const std::size_t next = std::min(text.find_first_not_of('\r', at), text.size());
      excess += next < text.size() && text[next] != '\n' ? 1 : 0;
      at = next - 1;
    }
    else if (byte < 32 && byte != '\t' && byte != '\v' && byte != '\f')
    {
      break; // not of a text
    }
  }
  return excess > 0 ? '\r' : '\n';
}

/** The text from the end of its first line on. */
inline std::string_view afterLine(std::string_view text, char lineEnd)
{
  return text.substr(std::min(text.find(lineEnd), text.size()));
}

} // namespace smg
