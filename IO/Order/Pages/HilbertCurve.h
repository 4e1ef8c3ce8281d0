// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace smg
{

/** A Hilbert curve through a cube of 2^21 cells per side, by tables of two levels at a time. */
class HilbertCurve
{
public:
  /** The bits of a coordinate. A key has three times as many. */
  static constexpr int Bits = 21;
  static constexpr std::uint32_t Largest = (std::uint32_t(1) << Bits) - 1;

  HilbertCurve();

  /** The number of cells before the one at these coordinates, each at most Largest. */
  std::uint64_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) const
  {
    // The 22nd bits are zero, and so is their share of the key: it ends as 63 bits.
    std::uint64_t key = 0;
    std::uint32_t state = 0;
    for (int bit = Bits - 1; bit >= 0; bit -= 2)
    {
      const std::uint32_t place = (x >> bit & 3) | (y >> bit & 3) << 2 | (z >> bit & 3) << 4;
      const std::uint32_t step = this->Steps[state | place];
      key = key << 6 | (step & 63);
      state = step & ~63u;
    }
    return key;
  }

private:
  static constexpr int States = 24;
  /** By state * 64 + position: the next state * 64 + the next six bits of the key. */
  std::array<std::uint16_t, States * 64> Steps;
};

} // namespace smg
