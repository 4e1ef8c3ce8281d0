// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

namespace smg
{

/** An array that grows at its end, in memory accounted for by the workspace's pool. */
template <class T>
class GrowingArray
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  /** The workspace must outlive the array. */
  explicit GrowingArray(Workspace& workspace)
    : Space(&workspace)
  {
  }

  std::size_t size() const { return this->Size; }
  bool empty() const { return this->Size == 0; }
  T* data() { return reinterpret_cast<T*>(this->Memory.data()); }
  const T* data() const { return reinterpret_cast<const T*>(this->Memory.data()); }
  T& operator[](std::size_t i)
  {
    assert(i < this->Size);
    return this->data()[i];
  }
  const T& operator[](std::size_t i) const
  {
    assert(i < this->Size);
    return this->data()[i];
  }
  std::span<T> all() { return { this->data(), this->Size }; }
  std::span<const T> all() const { return { this->data(), this->Size }; }

  /** Throws Error if the pool has no memory left. */
  void push(const T& value)
  {
    if (this->Size == this->Memory.size() / sizeof(T))
    {
      this->reserve(std::max<std::size_t>(16, this->Size + this->Size / 2));
    }
    this->data()[this->Size++] = value;
  }
  void reserve(std::size_t count)
  {
    if (count > this->Memory.size() / sizeof(T))
    {
      Buffer larger(this->Space->pool(), count * sizeof(T));
      if (this->Size > 0)
      {
        std::memcpy(larger.data(), this->Memory.data(), this->Size * sizeof(T));
      }
      this->Memory = std::move(larger);
    }
  }
  /** Removes the elements, but keeps the memory. */
  void clear() { this->Size = 0; }

private:
  Workspace* Space;
  Buffer Memory;
  std::size_t Size = 0;
};

} // namespace smg
