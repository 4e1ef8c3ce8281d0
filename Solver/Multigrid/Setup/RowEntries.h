// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** The entries of consecutive rows, in memory that is kept when they are forgotten. */
template <class Entry>
class RowEntries
{
public:
  /** Room for at most `size` entries of the next row. */
  Entry* open(std::int64_t size)
  {
    // Grows only, since resize() clears what it adds.
    const std::size_t end = this->Used + static_cast<std::size_t>(size);
    this->Entries.resize(std::max(this->Entries.size(), end));
    return this->Entries.data() + this->Used;
  }
  /** Ends the row begun by open(). */
  void close(std::int64_t size) { this->Used += static_cast<std::size_t>(size); }

  std::int64_t bytes() const
  {
    return static_cast<std::int64_t>(this->Entries.capacity() * sizeof(Entry));
  }
  const Entry* data() const { return this->Entries.data(); }
  void clear() { this->Used = 0; }

private:
  std::vector<Entry> Entries;
  std::size_t Used = 0;
};

} // namespace smg
