// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

namespace smg
{

/** Converts consecutive scalars of `size` bytes from the byte order of this machine to another. */
inline void toByteOrder(std::endian order, std::span<std::byte> scalars, std::size_t size)
{
  if (order == std::endian::native || size == 1)
  {
    return;
  }
  for (std::size_t at = 0; at < scalars.size(); at += size)
  {
    const std::span<std::byte> scalar = scalars.subspan(at, size);
    std::reverse(scalar.begin(), scalar.end());
  }
}

} // namespace smg
