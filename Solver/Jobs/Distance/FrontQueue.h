// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace smg
{

/** A priority queue of numbers by their distances: a heap with four children per node. A number may
 * be in it several times. Distances are compared by their leading 21 binary digits only, which
 * keeps an entry at 8 bytes and suffices for a march that corrects. */
class FrontQueue
{
public:
  struct Entry
  {
    std::uint32_t key;
    std::uint32_t number;
  };

  explicit FrontQueue(Pool& pool)
    : Owner(pool)
  {
  }

  bool isEmpty() const { return this->Size == 0; }
  std::size_t size() const { return this->Size; }

  /** The exponent and the leading digits of a distance, which order non-negative numbers of any
   * size. Single precision would not do: its range excludes the distances of tiny and huge meshes.
   */
  static std::uint32_t keyOf(double distance)
  {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(distance) >> 31);
  }

  static double distanceOf(std::uint32_t key)
  {
    return std::bit_cast<double>(static_cast<std::uint64_t>(key) << 31);
  }

  void put(std::uint32_t number, double distance)
  {
    if ((this->Size + 1) * sizeof(Entry) > this->Memory.size())
    {
      this->Memory.grow(
        this->Owner, std::max<std::size_t>(4096, this->Size + this->Size / 2) * sizeof(Entry));
      this->Heap = reinterpret_cast<Entry*>(this->Memory.data());
    }
    const Entry entry{ keyOf(distance), number };
    std::size_t place = this->Size++;
    for (; place > 0 && this->Heap[(place - 1) / 4].key > entry.key; place = (place - 1) / 4)
    {
      this->Heap[place] = this->Heap[(place - 1) / 4];
    }
    this->Heap[place] = entry;
  }

  /** Removes the entry with the smallest distance. */
  Entry take()
  {
    const Entry first = this->Heap[0];
    const Entry last = this->Heap[--this->Size];
    std::size_t place = 0;
    for (std::size_t child = 1; child < this->Size; child = 4 * place + 1)
    {
      const std::size_t end = std::min(child + 4, this->Size);
      const Entry* const least = std::min_element(this->Heap + child, this->Heap + end,
        [](const Entry& a, const Entry& b) { return a.key < b.key; });
      if (least->key >= last.key)
      {
        break;
      }
      this->Heap[place] = *least;
      place = static_cast<std::size_t>(least - this->Heap);
    }
    this->Heap[place] = last;
    return first;
  }

private:
  Pool& Owner;
  Buffer Memory;
  Entry* Heap = nullptr;
  std::size_t Size = 0;
};

} // namespace smg
