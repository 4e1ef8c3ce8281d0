// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace smg
{

/** Items of `lanes` values of T that are created and released in any order. They are numbered from
 * 1; released slots are reused. */
template <class T>
class Slots
{
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) >= sizeof(std::int32_t));

public:
  explicit Slots(Pool& pool, int lanes = 1)
    : Owner(&pool)
    , Lanes(lanes)
  {
  }

  /** Creates an uninitialised item and returns its number. May move the others. */
  std::int32_t take()
  {
    const std::int32_t slot = this->Spare;
    if (slot != 0)
    {
      std::memcpy(&this->Spare, this->at(slot), sizeof(slot));
      return slot;
    }
    if (this->Used == this->Capacity)
    {
      this->grow();
    }
    return static_cast<std::int32_t>(++this->Used);
  }

  /** Releases the item. */
  void give(std::int32_t slot)
  {
    std::memcpy(this->at(slot), &this->Spare, sizeof(slot));
    this->Spare = slot;
  }

  T* at(std::int32_t slot) const
  {
    return reinterpret_cast<T*>(this->Memory.data()) +
           (static_cast<std::int64_t>(slot) - 1) * this->Lanes;
  }
  T& operator[](std::int32_t slot) const { return *this->at(slot); }

private:
  void grow()
  {
    constexpr std::int64_t First = 64;
    if (this->Used == INT32_MAX)
    {
      throw Error("too many cells are open at once: convert the mesh with the order bfs");
    }
    this->Capacity =
      std::min<std::int64_t>(INT32_MAX, std::max(First, this->Capacity + this->Capacity / 8));
    const auto bytes = static_cast<std::int64_t>(sizeof(T)) * this->Lanes * this->Capacity;
    this->Memory.grow(*this->Owner, static_cast<std::size_t>(bytes));
  }

  Pool* Owner;
  int Lanes;
  Buffer Memory;
  std::int64_t Used = 0, Capacity = 0;
  std::int32_t Spare = 0; // head of the linked list of free slots
};

} // namespace smg
