// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace smg
{

/** `lanes` values of T for each open vertex of a mesh stream, that is, one that a later cell may
 * use. The memory is at most about twice what the largest number of open vertices takes, and is
 * accounted for in a pool. */
template <class T>
class OpenValues
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  explicit OpenValues(Pool& pool, int lanes = 1)
    : Owner(&pool)
    , Lanes(static_cast<std::size_t>(lanes))
  {
  }

  /** Releases all vertices; the next one is vertex 0. */
  void restart()
  {
    this->Memory = {};
    this->First = this->End = 0;
  }

  /** Releases the vertices below `final`, immediately or later. */
  void release(std::int64_t final)
  {
    // Values are moved only when more than half of them are released: on average less than one move
    // per value.
    if (final - this->First > (this->End - this->First) / 2)
    {
      const std::size_t kept = this->place(this->End) - this->place(final);
      std::memmove(this->at(this->First), this->at(final), kept * sizeof(T));
      this->First = final;
    }
  }

  /** Appends zeroed values for the next `vertices` vertices. Throws Error if there is no memory for
   * them. */
  std::span<T> append(std::int64_t vertices)
  {
    const std::size_t bytes = this->place(this->End + vertices) * sizeof(T);
    if (const std::size_t room = this->Memory.capacity(); bytes > room)
    {
      this->Memory.grow(*this->Owner, std::max(bytes, room + room / 8));
    }
    this->Memory.resize(bytes);
    const std::span<T> added(this->at(this->End), static_cast<std::size_t>(vertices) * this->Lanes);
    std::ranges::fill(added, T{});
    this->End += vertices;
    return added;
  }

  /** Starts the next block of a stream that may be read several times: returns zeroed values for
   * its vertices, in the place of those that the block before was the last one to use. */
  std::span<T> startBlock(const MeshBlock& block)
  {
    if (block.firstVertex == 0)
    {
      this->restart();
      this->Finalized = 0;
    }
    this->release(this->Finalized);
    this->Finalized = block.finalized;
    return this->append(block.vertices());
  }

  /** The values of an open vertex. */
  T* at(std::int64_t vertex) { return this->data() + this->place(vertex); }
  const T* at(std::int64_t vertex) const { return this->data() + this->place(vertex); }

private:
  T* data() const { return reinterpret_cast<T*>(this->Memory.data()); }
  std::size_t place(std::int64_t vertex) const
  {
    return static_cast<std::size_t>(vertex - this->First) * this->Lanes;
  }

  Pool* Owner;
  std::size_t Lanes;
  Buffer Memory;
  std::int64_t First = 0, End = 0; ///< the vertices that have values
  std::int64_t Finalized = 0;      ///< of the block before
};

} // namespace smg
