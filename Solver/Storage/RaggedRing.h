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

/**
 * Rows of any length of an endless array of rows, the part of it that is in memory. A row lies in
 * one piece: one that does not fit before the end of the memory goes to its beginning.
 */
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

  /** The first row that is there. */
  std::int64_t first() const { return this->Ends.first(); }
  /** Number of rows appended. */
  std::int64_t end() const { return this->Ends.end() - 1; }
  std::int64_t size(std::int64_t row) const { return this->Ends[row + 1] - this->start(row); }
  T* row(std::int64_t row) const { return this->data() + this->start(row); }

  /** Room for at most `size` entries of the next row. */
  T* open(std::int64_t size)
  {
    if (!this->fits(size))
    {
      this->grow(size);
    }
    return this->opened();
  }
  /** The row that open() has made room for. */
  T* opened() const { return this->data() + this->Open; }
  /** Ends the row that open() began after `size` entries. */
  void close(std::int64_t size)
  {
    const std::int64_t row = this->Ends.end();
    this->Ends.extendRaw(row + 1);
    // An empty row stays where the one before it ends, so that its own end does not lie below.
    this->Ends[row] =
      size > 0 ? static_cast<std::uint32_t>(this->Open + size) : this->Ends[row - 1];
  }

  /** Lets go of the rows below `row`. */
  void release(std::int64_t row) { this->Ends.release(row); }

private:
  T* data() const { return reinterpret_cast<T*>(this->Memory.data()); }
  std::int64_t capacity() const
  {
    return static_cast<std::int64_t>(this->Memory.size() / sizeof(T));
  }

  /** A row begins where the one before it ends, or at the beginning if it ends below that. */
  std::int64_t start(std::int64_t row) const
  {
    const std::uint32_t before = this->Ends[row];
    return this->Ends[row + 1] >= before ? before : 0;
  }

  /** Chooses the place of a row of `size` entries, if there is one. */
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

  /** Enlarges the memory so that a row of `size` entries follows. */
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

  /** Moves the rows from `first` on that lie before the end of the memory by `distance` entries. */
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
  Ring<std::uint32_t> Ends; ///< Ends[row + 1]: where the row ends, in entries
  std::int64_t Open = 0;    ///< where the row begins that open() made room for
};

} // namespace smg
