// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/** The number of entries that rows of any length usually have. On a cache line of its own, since
 * stages on different threads note theirs at the same time. */
class alignas(64) UsualEntries
{
public:
  /** Notes a row with so many entries. */
  void add(std::int64_t entries)
  {
    ++this->Rows;
    this->Entries += entries;
  }

  /** Some more than so many rows had on average so far. */
  std::int64_t of(std::int64_t rows) const
  {
    constexpr std::int64_t AtFirst = 8;
    const std::int64_t usual = this->Rows > 0 ? rows * this->Entries / this->Rows : AtFirst * rows;
    return usual + usual / 8;
  }

private:
  std::int64_t Rows = 0, Entries = 0;
};

} // namespace smg
