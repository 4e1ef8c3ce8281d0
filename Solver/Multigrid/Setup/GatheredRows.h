// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseEntry.h"
#include "Solver/Multigrid/Setup/RowEntries.h"
#include "Solver/Multigrid/Setup/StrongestWeight.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** What is known of an off-diagonal row of -P^T A P when it has been gathered. */
struct GatheredRow
{
  std::int64_t size;
  double alpha; ///< the row sum of P^T A P
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
