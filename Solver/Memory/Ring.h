// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <type_traits>

namespace smg
{

/**
 * Memory that is mapped three times in a row. Accesses beyond an end of the middle image continue
 * at the other end, so the neighbours of an item of a ring buffer are accessed without a wrap test.
 * A page counts as resident once for each image in which it is touched: accesses should start in
 * the middle image, so that most pages count once.
 */
class SMG_EXPORT MirroredMemory
{
public:
  static constexpr std::size_t PageBytes = 4096;

  explicit MirroredMemory(Pool& pool)
    : Owner(&pool)
  {
  }
  ~MirroredMemory() { this->clear(); }
  MirroredMemory(MirroredMemory&& other) noexcept;
  MirroredMemory& operator=(MirroredMemory&& other) noexcept;

  /** The middle image. */
  std::byte* data() const { return this->Data; }
  std::size_t size() const { return this->Size; }

  /** Grows to `bytes`, a multiple of PageBytes. The content keeps its offsets; the address may
   * change, also where there is no memory for more. Throws Error. */
  void grow(std::size_t bytes);
  void clear();

private:
  void moveInto(std::size_t bytes);
  void growFile(std::size_t bytes);
  void unmap();

  Pool* Owner;
  std::byte* Data = nullptr;
  std::size_t Size = 0;
  int Descriptor = -1; // of a large one
  int Process = 0;     // that mapped a small one
};

/**
 * The part [first, end) of an unbounded array of items, each of `lanes` values of T, that is in
 * memory. Items are addressed by their index in the unbounded array. The neighbours of any item are
 * contiguous in memory (MirroredMemory), so `at(i) + lanes * d` is item i + d. But at(i + d) may
 * point to another image of it: two results of at() do not bound a range.
 */
template <class T>
class Ring
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  explicit Ring(Pool& pool, int lanes = 1)
    : Memory(pool)
    , Lanes(lanes)
  {
  }

  std::int64_t first() const { return this->First; }
  std::int64_t end() const { return this->End; }
  int lanes() const { return this->Lanes; }
  /** The number of items for which there is memory. */
  std::int64_t capacity() const { return this->Capacity; }

  /** The first value of item `i`, first() <= i <= end(). */
  T* at(std::int64_t i) const
  {
    const std::int64_t slot = i - this->Lap;
    return this->Slots + (slot < this->Capacity ? slot : slot - this->Capacity) * this->Lanes;
  }
  T& operator[](std::int64_t i) const { return *this->at(i); }
  /** The values of items [begin, end). */
  std::span<T> range(std::int64_t begin, std::int64_t end) const
  {
    return { this->at(begin), static_cast<std::size_t>((end - begin) * this->Lanes) };
  }

  /** Appends items end() .. end - 1, zeroed. May move the memory. Throws Error. */
  void extend(std::int64_t end)
  {
    const std::int64_t before = this->End;
    this->extendRaw(end);
    if (end > before)
    {
      std::ranges::fill(this->range(before, end), T{});
    }
  }

  /** Like extend(), without initialising the appended items. */
  void extendRaw(std::int64_t end)
  {
    if (end > this->End)
    {
      this->reserve(end - this->First);
      this->End = end;
    }
  }

  /** Releases the items below `first`; if that is beyond the end, it is the next item. */
  void release(std::int64_t first)
  {
    if (first > this->End)
    {
      this->restart(first);
      return;
    }
    this->First = std::max(this->First, first);
    while (this->First - this->Lap >= this->Capacity && this->Capacity > 0)
    {
      this->Lap += this->Capacity;
    }
  }

  /** Releases all items and keeps the memory; the next item is `next`. */
  void restart(std::int64_t next = 0)
  {
    this->First = this->End = next;
    this->Lap = this->Capacity > 0 ? next - next % this->Capacity : 0;
  }

  /** Releases all items and the memory. */
  void clear()
  {
    this->Memory.clear();
    this->Capacity = 0;
    this->Slots = nullptr;
    this->restart();
  }

  /** Provides capacity for `items` items. */
  void reserve(std::int64_t items)
  {
    if (items > this->Capacity)
    {
      this->grow(std::max(items, this->Capacity + this->Capacity / 32));
    }
  }

  /** Provides capacity for `items` more items. */
  void reserveMore(std::int64_t items) { this->reserve(this->End - this->First + items); }

private:
  void grow(std::int64_t items)
  {
    this->Lap = this->Capacity == 0 ? this->First : this->Lap;
    const auto itemBytes = static_cast<std::int64_t>(sizeof(T)) * this->Lanes;
    const std::int64_t page = MirroredMemory::PageBytes;
    // The images are mapped by whole pages and hold whole items: the capacity in items is a
    // multiple of this.
    const std::int64_t granule = page / std::gcd(page, itemBytes);
    const std::int64_t capacity = (items + granule - 1) / granule * granule;
    const std::int64_t added = capacity - this->Capacity;
    const std::int64_t wrapped = this->End - this->Lap - this->Capacity;
    try
    {
      this->Memory.grow(static_cast<std::size_t>(capacity * itemBytes));
    }
    catch (...)
    {
      this->Slots = reinterpret_cast<T*>(this->Memory.data());
      throw;
    }
    if (wrapped > 0)
    {
      // The items that had wrapped around are at the beginning of the memory. They follow the
      // others, so they move into the new part, as many as fit; the rest moves up to the beginning.
      std::byte* data = this->Memory.data();
      const std::int64_t moved = std::min(wrapped, added);
      std::memcpy(
        data + this->Capacity * itemBytes, data, static_cast<std::size_t>(moved * itemBytes));
      std::memmove(
        data, data + moved * itemBytes, static_cast<std::size_t>((wrapped - moved) * itemBytes));
    }
    this->Capacity = capacity;
    this->Slots = reinterpret_cast<T*>(this->Memory.data());
  }

  MirroredMemory Memory;
  T* Slots = nullptr;        // position of item Lap
  std::int64_t Lap = 0;      // at most First, First - Lap < Capacity
  std::int64_t Capacity = 0; // items
  std::int64_t First = 0;
  std::int64_t End = 0;
  int Lanes;
};

/**
 * A window of a non-decreasing sequence of 64-bit indices, of which the low 32 bits are stored. All
 * values in memory are within 2^31 of a reference, which determines the high bits: the last value
 * at the last call of release(), or, if none was left then, the first value after it. append() does
 * not change the reference otherwise, so a thread may append while others read earlier values, if
 * there is room.
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

  /** Provides room for `more` more values. */
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
