// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Buffer.h"
#include "Solver/Storage/Ring.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace smg
{

/** The part in memory of an unbounded array of rows of any length. Rows are contiguous: a row that
 * does not fit before the end of the memory is stored at its beginning. */
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
  /** The number of appended rows. */
  std::int64_t end() const { return this->Ends.end() - 1; }
  std::int64_t size(std::int64_t row) const { return this->Ends[row + 1] - this->start(row); }
  T* row(std::int64_t row) const { return this->data() + this->start(row); }

  /** Opens the next row with room for at most `size` entries. */
  T* open(std::int64_t size)
  {
    if (!this->fits(size))
    {
      this->grow(size);
    }
    return this->opened();
  }
  /** The open row. */
  T* opened() const { return this->data() + this->Open; }
  /** Closes the open row with `size` entries. */
  void close(std::int64_t size)
  {
    const std::int64_t row = this->Ends.end();
    this->Ends.extendRaw(row + 1);
    // An empty row ends where the previous one ends, so that the ends do not decrease.
    this->Ends[row] =
      size > 0 ? static_cast<std::uint32_t>(this->Open + size) : this->Ends[row - 1];
  }

  /** Provides room for so many more rows with so many entries in all: until they are appended, rows
   * do not move, so that other threads may read earlier ones. */
  void reserve(std::int64_t rows, std::int64_t entries)
  {
    this->Ends.reserve(this->Ends.end() - this->Ends.first() + rows);
    if (!this->fits(entries))
    {
      this->grow(entries);
    }
  }

  /** Whether a row of `size` entries fits without moving the others. */
  bool hasRoom(std::int64_t size) { return this->fits(size); }

  /** Releases the rows below `row`. */
  void release(std::int64_t row) { this->Ends.release(row); }

private:
  T* data() const { return reinterpret_cast<T*>(this->Memory.data()); }
  std::int64_t capacity() const
  {
    return static_cast<std::int64_t>(this->Memory.size() / sizeof(T));
  }

  /** A row begins at the end of the previous one, or at 0 if its own end is below that. */
  std::int64_t start(std::int64_t row) const
  {
    const std::uint32_t before = this->Ends[row];
    return this->Ends[row + 1] >= before ? before : 0;
  }

  /** Chooses the position of a row of `size` entries; returns whether there is one. */
  bool fits(std::int64_t size)
  {
    const std::int64_t last = this->end();
    const std::int64_t tail = this->Ends[last];
    const std::int64_t first = this->Ends.first();
    const std::int64_t head = first < last ? this->start(first) : tail;
    this->Open = tail;
    if (tail < head)
    {
      return tail + size < head;
    }
    if (tail + size <= this->capacity())
    {
      return true;
    }
    this->Open = 0;
    return size < head;
  }

  /** Enlarges the memory so that a row of `size` entries fits. */
  void grow(std::int64_t size)
  {
    const std::int64_t last = this->end();
    const std::int64_t tail = this->Ends[last];
    const std::int64_t first = this->Ends.first();
    const std::int64_t head = first < last ? this->start(first) : tail;
    const bool wrapped = tail < head;
    const std::int64_t before = this->capacity();
    const std::int64_t least = wrapped ? before + tail + size + 1 - head : tail + size;
    const std::int64_t entries = std::max(least, before + before / 32);
    if (entries > UINT32_MAX)
    {
      throw Error(
        "neighbours lie too far apart in the stream: convert the mesh with the order bfs");
    }
    this->Memory.grow(*this->Owner, static_cast<std::size_t>(entries) * sizeof(T));
    if (wrapped)
    {
      this->moveToEnd(first, this->capacity() - before);
    }
    this->Open = tail;
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
  std::int64_t Open = 0;    ///< begin of the open row
};

} // namespace smg
