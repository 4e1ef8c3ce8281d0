// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace smg::benchmark
{

/**
 * A random permutation of 0 <= i < count (at least 1) that is computed, not stored: a Feistel
 * network on the smallest square of a power of two that holds them, repeated until the result is
 * one of them.
 */
class RandomOrder
{
public:
  RandomOrder(std::uint64_t count, std::uint64_t seed)
    : Count(count)
    , HalfBits((std::bit_width(count - 1) + 1) / 2)
    , Mask((std::uint64_t(1) << this->HalfBits) - 1)
  {
    for (std::uint64_t& key : this->Keys)
    {
      key = seed = mixed(seed + 0x9e3779b97f4a7c15);
    }
  }

  /** The place of item `i`. */
  std::uint64_t place(std::uint64_t i) const
  {
    do
    {
      std::uint64_t left = i >> this->HalfBits, right = i & this->Mask;
      for (const std::uint64_t key : this->Keys)
      {
        const std::uint64_t next = left ^ (mixed(right ^ key) & this->Mask);
        left = right;
        right = next;
      }
      i = left << this->HalfBits | right;
    } while (i >= this->Count);
    return i;
  }

  /** The item at `place`: place(item(p)) == p. */
  std::uint64_t item(std::uint64_t place) const
  {
    do
    {
      std::uint64_t left = place >> this->HalfBits, right = place & this->Mask;
      for (auto key = this->Keys.rbegin(); key != this->Keys.rend(); ++key)
      {
        const std::uint64_t previous = right ^ (mixed(left ^ *key) & this->Mask);
        right = left;
        left = previous;
      }
      place = left << this->HalfBits | right;
    } while (place >= this->Count);
    return place;
  }

private:
  /** The finaliser of SplitMix64. */
  static std::uint64_t mixed(std::uint64_t x)
  {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27) * 0x94d049bb133111eb;
    return x ^ x >> 31;
  }

  std::uint64_t Count;
  int HalfBits;
  std::uint64_t Mask;
  std::array<std::uint64_t, 4> Keys;
};

} // namespace smg::benchmark
