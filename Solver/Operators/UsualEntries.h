// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace smg
{

/** The number of entries that rows of any length usually have. On a cache line of its own, since
 * stages on different threads note theirs at the same time. */
class alignas(64) UsualEntries
{
public:
  /** `atFirst`: the entries of a row while none has been noted. */
  explicit UsualEntries(std::int64_t atFirst = 8)
    : AtFirst(atFirst)
  {
  }

  /** Notes a row with so many entries. */
  void add(std::int64_t entries)
  {
    ++this->Rows;
    this->Entries += entries;
  }

  /** Some more than so many rows had on average so far. */
  std::int64_t of(std::int64_t rows) const
  {
    const std::int64_t usual = rows * (this->Rows > 0 ? this->Entries : this->AtFirst) /
                               std::max<std::int64_t>(this->Rows, 1);
    return usual + usual / 8;
  }

private:
  std::int64_t AtFirst, Rows = 0, Entries = 0;
};

} // namespace smg
