// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace smg
{

/**
 * A coarse index by its low 32 bits. All that are alive at once lie near each other, so the rest
 * follows from any of them.
 */
using CoarseIndex = std::uint32_t;

/** Distance of a coarse index from `near`, whose full index is known. */
inline std::int32_t offset(CoarseIndex index, std::int64_t near)
{
  return static_cast<std::int32_t>(index - static_cast<CoarseIndex>(near));
}

/** Fewer coarse nodes than this may be alive at once: most entries know them by 24 bits. */
inline constexpr std::int64_t CoarseWindow = std::int64_t(1) << 23;

/** Distance of a coarse index, whose low 24 bits are the upper ones of `bits`, from `near`, which
 * is alive. */
inline std::int32_t coarseDistance(std::uint32_t bits, std::int64_t near)
{
  // The lower bits of `bits` are lost without a borrow.
  return static_cast<std::int32_t>(bits - (static_cast<std::uint32_t>(near) << 8)) >> 8;
}

/**
 * A coarse node and a number that belongs to it, in six bytes: most of what coarsening keeps in
 * memory are these. The number is a float of which 15 bits of the mantissa are kept; it is an entry
 * of an operator that preconditions and whose row sums are kept by themselves.
 */
class CoarseEntry
{
public:
  CoarseEntry() = default;
  CoarseEntry(CoarseIndex coarse, float value)
  {
    const std::uint64_t bits = std::uint64_t(coarse) << 24 | rounded(value);
    std::memcpy(this->Bytes.data(), &bits, sizeof(*this));
  }

  float value() const { return std::bit_cast<float>(this->load(0) << 8); }
  void setValue(float value)
  {
    const std::uint32_t bits = rounded(value);
    std::memcpy(this->Bytes.data(), &bits, 3);
  }

  /** Distance of the coarse node from `near`, which is alive. */
  std::int32_t offset(std::int64_t near) const { return coarseDistance(this->load(2), near); }

private:
  /** The upper 24 bits of the nearest number that has no more; the usual NaN stays one. */
  static std::uint32_t rounded(float value)
  {
    return (std::bit_cast<std::uint32_t>(value) + 128) >> 8;
  }
  std::uint32_t load(std::size_t at) const
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, this->Bytes.data() + at, sizeof(bits));
    return bits;
  }

  std::array<std::byte, 6> Bytes; // 24 bits of the number, then 24 of the index
};
static_assert(sizeof(CoarseEntry) == 6 && std::endian::native == std::endian::little);

} // namespace smg
