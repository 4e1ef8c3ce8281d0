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

/** The low 32 bits of a coarse index. Indices that are alive at once are close to each other, so
 * the rest follows from any of them. */
using CoarseIndex = std::uint32_t;

/**
 * Fewer coarse nodes than this may be alive at once: most entries store 24 bits of their indices.
 */
inline constexpr std::int64_t CoarseWindow = std::int64_t(1) << 23;

/** The distance of a coarse index, whose low 24 bits are the upper ones of `bits`, from `near`,
 * which is alive. */
inline std::int32_t coarseDistance(std::uint32_t bits, std::int64_t near)
{
  // The lower bits of `bits` are lost without a borrow.
  return static_cast<std::int32_t>(bits - (static_cast<std::uint32_t>(near) << 8)) >> 8;
}

/** A coarse node and its number, in seven bytes: most of the memory of coarsening consists of
 * these. Numbers of fewer bits would be sufficient except for slivers, whose rows nearly cancel. */
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

  /** Marks the entry as removed: it no longer has a value. */
  void remove() { this->setValue(std::numeric_limits<float>::quiet_NaN()); }
  bool removed() const { return std::isnan(this->value()); }
  /** Copies `other`, which may be removed, except for the coarse node. */
  void takeValue(const CoarseEntry& other) { this->setValue(other.value()); }

  /** The distance of the coarse node from `near`, which is alive. */
  std::int32_t offset(std::int64_t near) const { return coarseDistance(this->load(3), near); }

private:
  std::uint32_t load(std::size_t at) const
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, this->Bytes.data() + at, sizeof(bits));
    return bits;
  }

  std::array<std::byte, 7> Bytes; // the number, then 24 bits of the index
};
static_assert(sizeof(CoarseEntry) == 7 && std::endian::native == std::endian::little);

/** What is known of an off-diagonal row of -P^T A P when it has been gathered. */
struct GatheredRow
{
  std::int64_t size;
  double rowSum; ///< the row sum of P^T A P
  float diagonal;
  StrongestWeight strongest;
  std::int32_t lower; ///< entries below the row
  bool kept;          ///< whether none of its entries may be removed
};

/** Coarse rows made by one thread, which sparsification, perhaps on another one, takes. They are
 * those of a step, see StepLimit, and not accounted for. */
class GatheredRows
{
public:
  /** Room for at most `size` entries of the next row. */
  CoarseEntry* open(std::int64_t size) { return this->Entries.open(size); }
  /** Ends the row begun by open(), whose entries have ascending columns. */
  void close(const GatheredRow& row)
  {
    this->Entries.close(row.size);
    this->Rows.push_back(row);
  }

  /** Calls use(row, entries) for each row and forgets them. */
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
