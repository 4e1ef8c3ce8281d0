// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Error.h"
#include "Solver/Storage/Buffer.h"
#include "Solver/Storage/Ring.h"

#include <algorithm>
#include <cstdint>

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

  /** Moves the rows to the beginning of larger memory, in which one of `size` entries follows. */
  void grow(std::int64_t size)
  {
    const std::int64_t first = this->Ends.first();
    std::int64_t used = 0;
    for (std::int64_t row = first; row < this->end(); ++row)
    {
      used += this->size(row);
    }
    const std::int64_t most = std::max(used + size + 1, this->capacity() + this->capacity() / 8);
    if (most > UINT32_MAX)
    {
      throw Error(
        "neighbours lie too far apart in the stream: convert the mesh with the order bfs");
    }
    Buffer larger(*this->Owner, static_cast<std::size_t>(most) * sizeof(T));
    T* to = reinterpret_cast<T*>(larger.data());
    std::int64_t place = 0;
    std::uint32_t before = this->Ends[first];
    this->Ends[first] = 0;
    for (std::int64_t row = first; row < this->end(); ++row)
    {
      const std::uint32_t end = this->Ends[row + 1];
      const std::uint32_t start = end >= before ? before : 0;
      std::copy_n(this->data() + start, end - start, to + place);
      place += end - start;
      before = end;
      this->Ends[row + 1] = static_cast<std::uint32_t>(place);
    }
    this->Memory = std::move(larger);
    this->Open = place;
  }

  Pool* Owner;
  Buffer Memory;
  Ring<std::uint32_t> Ends; ///< Ends[row + 1]: where the row ends, in entries
  std::int64_t Open = 0;    ///< where the row begins that open() made room for
};

} // namespace smg
