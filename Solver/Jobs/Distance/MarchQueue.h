// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace smg
{

/** A queue of vertices of a window by their distances: a heap with four children a node. Its order
 * is that of the distances to 21 binary digits, which is enough for a march that corrects. */
class MarchQueue
{
public:
  MarchQueue(Pool& pool, std::int64_t vertices)
    : Memory(pool, static_cast<std::size_t>(vertices + 1) * sizeof(Entry))
    , PlaceMemory(pool, static_cast<std::size_t>(vertices) * sizeof(std::uint32_t))
    , Heap(reinterpret_cast<Entry*>(this->Memory.data()))
    , Places(reinterpret_cast<std::uint32_t*>(this->PlaceMemory.data()))
  {
    std::memset(this->Places, 0, this->PlaceMemory.size());
  }

  /** Memory of a queue for so many vertices. */
  static constexpr std::int64_t bytes(std::int64_t vertices)
  {
    return (vertices + 1) * std::int64_t(sizeof(Entry) + sizeof(std::uint32_t));
  }

  bool isEmpty() const { return this->Size == 0; }

  /** Adds the vertex, or moves it forward if it is in the queue. */
  void put(std::uint32_t vertex, double distance)
  {
    const Entry entry{ keyOf(distance), vertex };
    std::uint32_t place = this->Places[vertex];
    if (place == 0)
    {
      place = ++this->Size;
    }
    while (place > 1)
    {
      const std::uint32_t parent = (place + 2) / 4;
      if (this->Heap[parent].key <= entry.key)
      {
        break;
      }
      this->set(place, this->Heap[parent]);
      place = parent;
    }
    this->set(place, entry);
  }

  /** Removes the vertex with the smallest distance. */
  std::uint32_t take()
  {
    const std::uint32_t first = this->Heap[1].vertex;
    this->Places[first] = 0;
    const Entry last = this->Heap[this->Size--];
    if (this->Size > 0)
    {
      this->sink(last);
    }
    return first;
  }

private:
  struct Entry
  {
    std::uint32_t key;
    std::uint32_t vertex;
  };

  /** The exponent of a distance and the first digits, which order numbers from 0 on of any size:
   * single precision would not tell those of a tiny or a huge mesh apart. */
  static std::uint32_t keyOf(double distance)
  {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(distance) >> 31);
  }

  void set(std::uint32_t place, const Entry& entry)
  {
    this->Heap[place] = entry;
    this->Places[entry.vertex] = place;
  }

  /** Puts an entry in place of the first one. */
  void sink(const Entry& entry)
  {
    std::uint32_t place = 1;
    for (;;)
    {
      // The children of place 1 are 2 to 5.
      const std::uint32_t child = 4 * place - 2;
      if (child > this->Size)
      {
        break;
      }
      const Entry* const least =
        std::min_element(this->Heap + child, this->Heap + std::min(child + 4, this->Size + 1),
          [](const Entry& a, const Entry& b) { return a.key < b.key; });
      if (least->key >= entry.key)
      {
        break;
      }
      const auto next = static_cast<std::uint32_t>(least - this->Heap);
      this->set(place, *least);
      place = next;
    }
    this->set(place, entry);
  }

  Buffer Memory, PlaceMemory;
  Entry* Heap;           ///< from 1 on
  std::uint32_t* Places; ///< of a vertex in the heap; 0: none
  std::uint32_t Size = 0;
};

} // namespace smg
