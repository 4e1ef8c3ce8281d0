// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"

#include <cstdint>

namespace smg
{

/**
 * A window of a non-decreasing sequence of 64-bit indices, stored by their low 32 bits: all values
 * in memory are within 2^31 of the last one at the last call of release(), or of the first one
 * after it if none was left, which determines the high bits. So a thread may append while others
 * read earlier values, if there is room.
 */
class MonotoneRing
{
public:
  explicit MonotoneRing(Pool& pool, std::int64_t before)
    : Low(pool)
    , Last(before)
    , Near(before)
  {
  }

  std::int64_t end() const { return this->Low.end(); }
  /** The last value, or the initial one if there is none. */
  std::int64_t last() const { return this->Last; }

  std::int64_t operator[](std::int64_t i) const
  {
    return this->Near +
           static_cast<std::int32_t>(this->Low[i] - static_cast<std::uint32_t>(this->Near));
  }

  /** Appends `value`, or the last one if that is larger. */
  void append(std::int64_t value)
  {
    const std::int64_t i = this->end();
    this->Last = std::max(this->Last, value);
    if (i == this->Low.first())
    {
      this->Near = this->Last;
    }
    this->Low.extendRaw(i + 1);
    this->Low[i] = static_cast<std::uint32_t>(this->Last);
  }

  /** Provides room for so many more values. */
  void reserve(std::int64_t more) { this->Low.reserve(this->end() - this->Low.first() + more); }

  /** Releases the values below `first`; if that is beyond the end, it is the next one. */
  void release(std::int64_t first)
  {
    this->Low.release(first);
    this->Near = this->Last;
  }

private:
  Ring<std::uint32_t> Low;
  std::int64_t Last, Near;
};

} // namespace smg
