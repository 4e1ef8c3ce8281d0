// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/LevelRows.h"
#include "Solver/Hierarchy/RowEntries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Rows made by one thread, which are moved to the rows of the level between two steps, when no
 * thread accesses these. */
class RowBatch
{
public:
  /** Room for at most `size` entries of the next row. */
  RowEntry* open(std::int64_t size) { return this->Entries.open(size); }

  /** Ends the row begun by open(); see LevelRows::close. */
  void close(std::int64_t size, double alpha, std::int64_t childReach, bool stiff = false,
    std::span<const double> precise = {})
  {
    this->Entries.close(size);
    this->Closed.push_back({ size, alpha, childReach, stiff, precise.size() });
    this->Precise.insert(this->Precise.end(), precise.begin(), precise.end());
  }

  /** Appends the rows to `rows` and forgets them. */
  void moveTo(LevelRows& rows)
  {
    const RowEntry* entry = this->Entries.data();
    const double* precise = this->Precise.data();
    for (std::span<const ClosedRow> left = this->Closed; !left.empty();)
    {
      // Rows of a group are contiguous, which may leave some room before the end of the memory.
      constexpr std::size_t Group = 64;
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
  }

private:
  RowEntries<RowEntry> Entries;
  std::vector<double> Precise;
  std::vector<ClosedRow> Closed;
};

} // namespace smg
