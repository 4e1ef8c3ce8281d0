// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

namespace smg
{

/** The upper half of a float: its range with 8 bits of precision, rounded to nearest. */
class BFloat16
{
public:
  BFloat16() = default;
  /** `value` must not be NaN. */
  explicit BFloat16(float value)
  {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    this->Bits = static_cast<std::uint16_t>((bits + 0x7FFFU + (bits >> 16 & 1U)) >> 16);
  }

  operator float() const
  {
    return std::bit_cast<float>(static_cast<std::uint32_t>(this->Bits) << 16);
  }

private:
  std::uint16_t Bits = 0;
};

} // namespace smg
