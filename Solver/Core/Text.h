// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

/** "12 MiB", rounded up. */
inline std::string mebibytes(std::int64_t bytes)
{
  return std::to_string((bytes >> 20) + (bytes % (1 << 20) > 0 ? 1 : 0)) + " MiB";
}

/** "12 MiB (12345678 bytes)". */
inline std::string exactMebibytes(std::int64_t bytes)
{
  return mebibytes(bytes) + " (" + std::to_string(bytes) + " bytes)";
}

/** "34,834" */
inline std::string groupedDigits(std::int64_t number)
{
  std::string digits = std::to_string(number);
  const std::ptrdiff_t first = number < 0 ? 1 : 0;
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > first; at -= 3)
  {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return digits;
}

/** The text without line breaks and other control characters, for an error message that quotes a
 * file. */
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
