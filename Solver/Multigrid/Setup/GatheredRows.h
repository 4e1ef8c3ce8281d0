// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/LevelRows.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace smg
{

/** The low 32 bits of a coarse index. Coarse nodes in memory at the same time lie close to each
 * other, so any of them determines the other bits. */
using CoarseIndex = std::uint32_t;

/** Fewer coarse nodes than this may be in memory at the same time, since most entries store 24
 * bits of an index. */
inline constexpr std::int64_t CoarseWindow = std::int64_t(1) << 23;

/** The distance from `near`, a coarse node in memory, of the coarse index whose low 24 bits are
 * the upper ones of `bits`. */
inline std::int32_t coarseDistance(std::uint32_t bits, std::int64_t near)
{
  // near << 8 ends in a zero byte: the low byte of `bits` causes no borrow and is shifted out.
  return static_cast<std::int32_t>(bits - (static_cast<std::uint32_t>(near) << 8)) >> 8;
}

/** A coarse index and a float in seven bytes, since most of the memory of coarsening consists of
 * these. Fewer bits for the number would do, except for sliver rows, which nearly cancel. */
class CoarseEntry
{
public:
  CoarseEntry() = default;
  CoarseEntry(CoarseIndex coarse, float value)
  {
    const std::uint32_t shifted = coarse << 8;
    std::memcpy(this->Bytes.data() + 3, &shifted, sizeof(shifted));
    this->setValue(value);
  }

  float value() const { return std::bit_cast<float>(this->load(0)); }
  void setValue(float value) { std::memcpy(this->Bytes.data(), &value, sizeof(value)); }

  /** Marks the entry as removed, by a NaN instead of its value that no calculation returns: the NaN
   * of an overflow is not taken for it, but spreads until it is noticed. */
  void remove() { this->setValue(std::bit_cast<float>(Removed)); }
  bool removed() const { return this->load(0) == Removed; }
  /** Copies the value of `other`, or that it is removed; the coarse node stays. */
  void takeValue(const CoarseEntry& other) { this->setValue(other.value()); }

  /** The distance of the coarse node from `near`, a coarse node in memory. */
  std::int32_t offset(std::int64_t near) const { return coarseDistance(this->load(3), near); }

private:
  static constexpr std::uint32_t Removed = 0x7fda7a11; // quiet, with digits of its own

  std::uint32_t load(std::size_t at) const
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, this->Bytes.data() + at, sizeof(bits));
    return bits;
  }

  std::array<std::byte, 7> Bytes; // the number, then 24 bits of the index
};
static_assert(sizeof(CoarseEntry) == 7 && std::endian::native == std::endian::little);

/** What is known of an off-diagonal row of -P^T A P when it is gathered. */
struct GatheredRow
{
  std::int64_t size;
  double rowSum; ///< the row sum of P^T A P
  float diagonal;
  StrongestWeight strongest;
  std::int32_t lower; ///< number of entries below the diagonal
  bool kept;          ///< whether none of its entries may be removed
};

/** Coarse rows that one thread makes and another one, running sparsification, may take.
 * StepLimit bounds how many a step makes, so the pool does not account for them. */
class GatheredRows
{
public:
  /** Room for at most `size` entries of the next row. */
  CoarseEntry* open(std::int64_t size) { return this->Entries.open(size); }
  /** Ends the row begun by open(); its entries have ascending columns. */
  void close(const GatheredRow& row)
  {
    this->Entries.close(row.size);
    this->Rows.push_back(row);
  }

  /** Calls use(row, entries) for each row, then removes all rows. */
  template <class Use>
  void take(Use&& use)
  {
    const CoarseEntry* entries = this->Entries.data();
    for (const GatheredRow& row : this->Rows)
    {
      use(row, entries);
      entries += row.size;
    }
    this->Rows.clear();
    this->Entries.clear();
  }

private:
  RowEntries<CoarseEntry> Entries;
  std::vector<GatheredRow> Rows;
};

} // namespace smg
