// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

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

} // namespace smg
