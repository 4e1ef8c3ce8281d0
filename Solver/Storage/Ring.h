// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/MirroredMemory.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <type_traits>

namespace smg
{

/**
 * The part [first, end) of an endless array of items that is in memory, an item being `lanes`
 * values of T. Items are addressed by their index in the endless array; items next to each other in
 * it are next to each other in memory (MirroredMemory), so `&ring[i] + lanes * d` is item i + d.
 */
template <class T>
class Ring
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  explicit Ring(Pool& pool, int lanes = 1)
    : Memory(pool)
    , Owner(&pool)
    , Lanes(lanes)
  {
  }

  std::int64_t first() const { return this->First; }
  std::int64_t end() const { return this->End; }
  int lanes() const { return this->Lanes; }

  /** The first value of item `i`, first() <= i <= end(). */
  T* at(std::int64_t i) const { return this->Lap0 + (i - this->Lap) * this->Lanes; }
  T& operator[](std::int64_t i) const { return *this->at(i); }

  /** Makes items end() .. end - 1 accessible, zeroed. May move the memory. Throws Error. */
  void extend(std::int64_t end)
  {
    const std::int64_t before = this->End;
    this->extendRaw(end);
    if (end > before)
    {
      std::fill(this->at(before), this->at(end), T{});
    }
  }

  /** As extend, but what the new items hold is left to chance. */
  void extendRaw(std::int64_t end)
  {
    if (end > this->End)
    {
      this->reserve(end - this->First);
      this->End = end;
    }
  }

  /** Lets go of the items below `first`. */
  void release(std::int64_t first)
  {
    this->First = std::max(this->First, first);
    while (this->First - this->Lap >= this->Capacity && this->Capacity > 0)
    {
      this->Lap += this->Capacity;
    }
  }

  /** Lets go of everything; the next item is `next`. The memory is kept. */
  void restart(std::int64_t next = 0)
  {
    this->First = this->End = next;
    this->Lap = this->Capacity > 0 ? next - next % this->Capacity : 0;
  }

  /** Lets go of everything, and of the memory. */
  void clear()
  {
    this->Memory.clear();
    this->Capacity = 0;
    this->Lap0 = nullptr;
    this->restart();
  }

  /** Room for `items` items at once. */
  void reserve(std::int64_t items)
  {
    if (items > this->Capacity)
    {
      this->grow(std::max(items, this->Capacity + this->Capacity / 8));
    }
  }

private:
  void grow(std::int64_t items)
  {
    const auto itemBytes = static_cast<std::int64_t>(sizeof(T)) * this->Lanes;
    const std::int64_t page = MirroredMemory::PageBytes;
    const std::int64_t granule = page / std::gcd(page, itemBytes);
    const std::int64_t capacity = (items + granule - 1) / granule * granule;
    if (this->Lap == 0 && this->End <= this->Capacity)
    {
      // Nothing has wrapped yet: every item keeps its place.
      this->Memory.grow(static_cast<std::size_t>(capacity * itemBytes));
    }
    else
    {
      MirroredMemory larger(*this->Owner);
      larger.grow(static_cast<std::size_t>(capacity * itemBytes));
      const std::int64_t slot = this->First % capacity;
      std::memcpy(larger.data() + slot * itemBytes, this->at(this->First),
        static_cast<std::size_t>((this->End - this->First) * itemBytes));
      this->Memory = std::move(larger);
      this->Lap = this->First - slot;
    }
    this->Capacity = capacity;
    this->Lap0 = reinterpret_cast<T*>(this->Memory.data());
  }

  MirroredMemory Memory;
  Pool* Owner;
  T* Lap0 = nullptr;         // where item Lap is
  std::int64_t Lap = 0;      // a multiple of Capacity, at most First, First - Lap < Capacity
  std::int64_t Capacity = 0; // items
  std::int64_t First = 0;
  std::int64_t End = 0;
  int Lanes;
};

} // namespace smg
