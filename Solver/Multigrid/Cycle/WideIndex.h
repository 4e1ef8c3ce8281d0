// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace smg
{

/** An index of a wide block in three bytes, enough for distances of rows and of parents. It is read
 * together with the preceding byte in one load, and therefore only in place in a block. */
class WideIndex
{
public:
  WideIndex() = default;
  /** From -2^23 to 2^23 - 1. */
  explicit WideIndex(std::int32_t index) { std::memcpy(this->Bytes.data(), &index, sizeof(*this)); }
  /** A copy would have another preceding byte. */
  WideIndex(const WideIndex&) = delete;
  WideIndex& operator=(const WideIndex&) = default;

  operator std::int64_t() const
  {
    std::int32_t shifted = 0;
    std::memcpy(&shifted, reinterpret_cast<const std::byte*>(this) - 1, sizeof(shifted));
    return std::int64_t(shifted) >> 8;
  }

private:
  std::array<std::byte, 3> Bytes;
};
static_assert(sizeof(WideIndex) == 3 && std::endian::native == std::endian::little);

} // namespace smg
