// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Pool.h"

#include <cstddef>
#include <cstdlib>
#include <new>
#include <span>
#include <utility>

namespace smg
{

/** Bytes of a block, aligned to a cache line and accounted for in a pool. What they hold is left to
 * chance. */
class Buffer
{
public:
  Buffer() = default;
  Buffer(Pool& pool, std::size_t bytes)
    : Owner(&pool)
    , Size(bytes)
    , Capacity((bytes + 63) / 64 * 64)
  {
    pool.acquire(static_cast<std::int64_t>(this->Capacity));
    this->Data = static_cast<std::byte*>(std::aligned_alloc(64, this->Capacity));
    if (!this->Data && this->Capacity > 0)
    {
      pool.release(static_cast<std::int64_t>(this->Capacity));
      throw std::bad_alloc();
    }
  }
  ~Buffer()
  {
    if (this->Owner)
    {
      std::free(this->Data);
      this->Owner->release(static_cast<std::int64_t>(this->Capacity));
    }
  }
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept
  {
    std::swap(this->Owner, other.Owner);
    std::swap(this->Data, other.Data);
    std::swap(this->Size, other.Size);
    std::swap(this->Capacity, other.Capacity);
    return *this;
  }

  std::byte* data() const { return this->Data; }
  std::size_t size() const { return this->Size; }
  std::span<std::byte> bytes() const { return { this->Data, this->Size }; }
  std::size_t capacity() const { return this->Capacity; }
  /** Uses the first `bytes` bytes, at most capacity(). */
  void resize(std::size_t bytes) { this->Size = bytes; }

private:
  Pool* Owner = nullptr;
  std::byte* Data = nullptr;
  std::size_t Size = 0;
  std::size_t Capacity = 0;
};

} // namespace smg
