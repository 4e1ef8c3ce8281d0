// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

namespace smg
{

/** The part of an unbounded array of rows of any length that is in memory. Rows are contiguous: a
 * row that does not fit before the end of the memory is stored at its beginning. */
template <class T>
class RaggedRing
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  explicit RaggedRing(Pool& pool)
    : Owner(&pool)
    , Ends(pool)
  {
    this->Ends.extend(1);
  }

  /** The first row in memory. */
  std::int64_t first() const { return this->Ends.first(); }
  /** The row to be appended next. */
  std::int64_t end() const { return this->Ends.end() - 1; }
  std::int64_t size(std::int64_t row) const { return this->Ends.at(row)[1] - this->start(row); }
  T* row(std::int64_t row) const { return this->data() + this->start(row); }

  /** The rows around a row, addressed by their distance from it. */
  class Near
  {
  public:
    Near(const std::uint32_t* ends, T* data)
      : Ends(ends)
      , Data(data)
    {
    }
    std::span<T> operator[](std::int32_t distance) const
    {
      const std::uint32_t* ends = this->Ends + distance;
      const std::uint32_t start = ends[1] >= ends[0] ? ends[0] : 0;
      return { this->Data + start, ends[1] - start };
    }

  private:
    const std::uint32_t* Ends;
    T* Data;
  };
  Near near(std::int64_t row) const { return { this->Ends.at(row), this->data() }; }

  /** Opens the next row with room for at most `size` entries. */
  T* open(std::int64_t size)
  {
    if (!this->hasRoom(size))
    {
      this->grow(size);
    }
    return this->opened();
  }
  /** The open row. */
  T* opened() const { return this->data() + this->Open; }
  /** Closes the open row with `size` entries. The room that it does not use belongs to the next
   * row. */
  void close(std::int64_t size)
  {
    const std::int64_t row = this->Ends.end();
    this->Ends.extendRaw(row + 1);
    // An empty row ends where the previous one ends, so that the ends do not decrease.
    if (size > 0)
    {
      this->Room -= this->Open + size - this->Tail;
      this->Tail = this->Open += size;
    }
    this->Ends[row] = static_cast<std::uint32_t>(this->Tail);
  }

  /** Provides room for `rows` more rows with `entries` entries in all. Until they are appended,
   * rows do not move, so other threads may read earlier ones. */
  void reserve(std::int64_t rows, std::int64_t entries)
  {
    this->Ends.reserve(this->Ends.end() - this->Ends.first() + rows);
    if (!this->hasRoom(entries))
    {
      this->grow(entries);
    }
  }

  /** Whether a row of `size` entries fits without moving the others. */
  bool hasRoom(std::int64_t size)
  {
    this->Open = this->Tail;
    return size <= this->Room || this->fits(size);
  }

  /** Releases the rows below `row`; if that is beyond the end, it is the next row. */
  void release(std::int64_t row)
  {
    const bool isBeyond = row > this->end();
    this->Ends.release(row);
    if (isBeyond)
    {
      this->Ends.restart(row);
      this->Ends.extend(row + 1);
      this->Tail = this->Room = 0;
    }
  }

private:
  T* data() const { return reinterpret_cast<T*>(this->Memory.data()); }
  std::int64_t capacity() const
  {
    return static_cast<std::int64_t>(this->Memory.size() / sizeof(T));
  }

  /** A row begins at the end of the previous one, or at 0 if its own end is below that. */
  std::int64_t start(std::int64_t row) const
  {
    const std::uint32_t* ends = this->Ends.at(row);
    return ends[1] >= ends[0] ? ends[0] : 0;
  }

  /** The begin of the first row in memory. */
  std::int64_t head() const
  {
    const std::int64_t first = this->Ends.first();
    return first < this->end() ? this->start(first) : this->Tail;
  }

  /** Chooses the position of a row of `size` entries and returns whether there is one. One entry
   * before the first row stays free: a full ring and an empty one would otherwise look alike. */
  bool fits(std::int64_t size)
  {
    const std::int64_t head = this->head();
    this->Room = this->Tail < head ? head - 1 - this->Tail : this->capacity() - this->Tail;
    if (size <= this->Room || this->Tail < head)
    {
      return size <= this->Room;
    }
    // At the beginning, before the first row. `Room` is what will be left from the tail, once this
    // row is closed.
    this->Room = head - 1 - this->Tail;
    this->Open = 0;
    return size < head;
  }

  /** Enlarges the memory so that a row of `size` entries fits. */
  void grow(std::int64_t size)
  {
    const std::int64_t head = this->head();
    const bool wrapped = this->Tail < head;
    const std::int64_t before = this->capacity();
    const std::int64_t least = wrapped ? before + this->Tail + size + 1 - head : this->Tail + size;
    const std::int64_t entries = std::max(least, before + before / 32);
    // The ends of rows are stored with 32 bits.
    if (entries > UINT32_MAX)
    {
      throw Error(
        "neighbours lie too far apart in the stream: convert the mesh with the order bfs");
    }
    this->Memory.grow(*this->Owner, static_cast<std::size_t>(entries) * sizeof(T));
    // The rows from the first one to the end of the old memory move to the end of the new one; the
    // gap before them is the new room.
    if (wrapped)
    {
      this->moveToEnd(this->Ends.first(), this->capacity() - before);
    }
    this->Open = this->Tail;
    this->Room = 0;
  }

  /** Moves the rows from `first` up to the end of the memory by `distance` entries. */
  void moveToEnd(std::int64_t first, std::int64_t distance)
  {
    const auto shift = static_cast<std::uint32_t>(distance);
    const std::uint32_t head = this->Ends[first];
    std::uint32_t end = head;
    this->Ends[first] += shift;
    for (std::int64_t row = first; this->Ends[row + 1] >= end; ++row)
    {
      end = this->Ends[row + 1];
      this->Ends[row + 1] += shift;
    }
    std::memmove(this->data() + head + shift, this->data() + head, (end - head) * sizeof(T));
  }

  Pool* Owner;
  Buffer Memory;
  Ring<std::uint32_t> Ends; ///< Ends[row + 1]: end of the row, in entries
  std::int64_t Tail = 0;    ///< end of the last row
  std::int64_t Room = 0;    ///< entries that certainly fit behind it
  std::int64_t Open = 0;    ///< begin of the open row
};

} // namespace smg
