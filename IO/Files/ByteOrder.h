// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace smg
{

/** The byte order that is not that of this machine. */
inline constexpr std::endian OtherByteOrder =
  std::endian::native == std::endian::little ? std::endian::big : std::endian::little;

/** Returns a number with its bytes in reverse order. */
template <class T>
T byteSwapped(T value)
{
  if constexpr (sizeof(T) == 1)
  {
    return value;
  }
  else if constexpr (sizeof(T) == 2)
  {
    return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  }
  else if constexpr (sizeof(T) == 4)
  {
    return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  }
  else
  {
    return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  }
}

/** Returns the number that begins at `bytes`, in their byte order. */
template <class T>
T numberAt(const void* bytes, std::endian order)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return order == std::endian::native ? value : byteSwapped(value);
}

/** Converts consecutive scalars of `size` bytes from the byte order of this machine to another, or
 * back. */
inline void toByteOrder(std::endian order, std::span<std::byte> scalars, std::size_t size)
{
  const auto swapAll = [scalars]<class T>(T)
  {
    for (std::size_t at = 0; at < scalars.size(); at += sizeof(T))
    {
      const T swapped = numberAt<T>(&scalars[at], OtherByteOrder);
      std::memcpy(&scalars[at], &swapped, sizeof(T));
    }
  };
  if (order != std::endian::native)
  {
    size == 2   ? swapAll(std::uint16_t())
    : size == 4 ? swapAll(std::uint32_t())
    : size == 8 ? swapAll(std::uint64_t())
                : void();
  }
}

} // namespace smg
