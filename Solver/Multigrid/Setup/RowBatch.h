// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "Solver/Multigrid/Setup/LevelRows.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Rows that one thread makes. Between two steps, when no thread reads the rows of the level,
 * they are moved there: appending may move memory that others read. */
class RowBatch
{
public:
  /** `further`: bytes that the owner keeps with each row, which this batch accounts for. */
  explicit RowBatch(Pool& pool, std::int64_t further = 0)
    : Further(further)
    , Memory(pool)
  {
  }

  /** Room for at most `size` entries of the next row. */
  RowEntry* open(std::int64_t size) { return this->Entries.open(size); }

  /** Ends the row begun by open(); see LevelRows::close. */
  void close(std::int64_t size, double rowSum, std::int64_t childReach, bool stiff = false,
    std::span<const double> precise = {})
  {
    this->Entries.close(size);
    this->Closed.push_back({ size, rowSum, childReach, stiff, precise.size() });
    this->Precise.insert(this->Precise.end(), precise.begin(), precise.end());
    if (this->Closed.size() % Group == 0)
    {
      this->account();
    }
  }
  /** Whether it has more memory than a batch keeps for the rows of later steps. */
  bool isLarge() const { return this->Memory.bytes() > 0; }

  /** Appends the rows to `rows` and removes them from the batch. */
  void moveTo(LevelRows& rows)
  {
    const RowEntry* entry = this->Entries.data();
    const double* precise = this->Precise.data();
    for (std::span<const ClosedRow> left = this->Closed; !left.empty();)
    {
      // The rows of a group are contiguous in the ring, which may leave a gap before the end of its
      // memory: small groups keep that gap small.
      const auto group = left.first(std::min(Group, left.size()));
      left = left.subspan(group.size());
      entry = rows.append(group, entry, precise);
      for (const ClosedRow& row : group)
      {
        precise += row.precise;
      }
    }
    this->Closed.clear();
    this->Precise.clear();
    this->Entries.clear();
    if (this->isLarge())
    {
      this->Entries = {};
      this->Precise = {};
      this->Closed = {};
      this->Memory.resize(0);
    }
  }

private:
  static constexpr std::size_t Group = 64;

  void account()
  {
    const std::int64_t bytes =
      this->Entries.bytes() +
      static_cast<std::int64_t>(
        this->Precise.capacity() * sizeof(double) + this->Closed.capacity() * sizeof(ClosedRow)) +
      this->Further * static_cast<std::int64_t>(this->Closed.size());
    this->Memory.resize(accountedBytes(bytes));
  }

  RowEntries<RowEntry> Entries;
  std::vector<double> Precise;
  std::vector<ClosedRow> Closed;
  std::int64_t Further;
  Reservation Memory;
};

/**
 * Appends the final coarse row c to `out`, with the last of its children; all of its neighbours
 * must have been sparsified. Its upper weights are copied to the mirrored entries, below the
 * diagonal, of the rows above it. Rows are finished in order, so in each of these it is the next
 * entry.
 */
SMG_EXPORT void finishRow(
  CoarseningData& data, std::int64_t c, std::int64_t lastChild, RowBatch& out);

} // namespace smg
