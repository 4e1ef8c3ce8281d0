// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/PackedIntegers.h"

#include <algorithm>

namespace smg
{

void packIntegers(std::span<const std::uint64_t> values, std::vector<std::byte>& packed)
{
  std::uint64_t all = 0;
  for (const std::uint64_t value : values)
  {
    all |= value;
  }
  int width = 0;
  while (width < 8 && (all >> (8 * width)) != 0)
  {
    width++;
  }
  packed.resize(1 + width * values.size());
  packed[0] = static_cast<std::byte>(width);
  std::byte* plane = packed.data() + 1;
  for (int b = 0; b < width; b++, plane += values.size())
  {
    for (std::size_t i = 0; i < values.size(); i++)
    {
      plane[i] = static_cast<std::byte>(values[i] >> (8 * b));
    }
  }
}

bool unpackIntegers(std::span<const std::byte> packed, std::span<std::uint64_t> values)
{
  const std::size_t width = packed.empty() ? 9 : std::to_integer<std::size_t>(packed[0]);
  if (width > 8 || packed.size() != 1 + width * values.size())
  {
    return false;
  }
  std::fill(values.begin(), values.end(), 0);
  const std::byte* plane = packed.data() + 1;
  for (std::size_t b = 0; b < width; b++, plane += values.size())
  {
    for (std::size_t i = 0; i < values.size(); i++)
    {
      values[i] |= std::to_integer<std::uint64_t>(plane[i]) << (8 * b);
    }
  }
  return true;
}

} // namespace smg
