// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace smg
{

/** The characters that end lines: LF, CR LF, or CR alone as of old Macintosh systems. */
inline constexpr std::string_view LineEnds = "\r\n";

/** The character that ends the lines of a text, by its first line: CR if no LF follows it, else LF.
 */
inline char lineEndOf(std::string_view text)
{
  const std::size_t end = text.find_first_of(LineEnds);
  const std::size_t next = text.find_first_not_of('\r', end);
  return end < text.size() && text[end] == '\r' && next < text.size() && text[next] != '\n' ? '\r'
                                                                                            : '\n';
}

} // namespace smg
