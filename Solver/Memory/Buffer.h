// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/SystemCalls.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <sys/mman.h>
#include <utility>
#include <vector>

namespace smg
{

/**
 * ThreadSanitizer does not track mremap() and would report earlier accesses at the same address.
 */
#ifdef __SANITIZE_THREAD__
inline constexpr bool ThreadsAreWatched = true;
#else
inline constexpr bool ThreadsAreWatched = false;
#endif

/** Uninitialised bytes of a block, aligned to a cache line and accounted for in a pool. */
class Buffer
{
public:
  Buffer() = default;
  Buffer(Pool& pool, std::size_t bytes)
    : Owner(&pool)
    , Size(bytes)
    , Capacity(roundedUp(bytes))
  {
    pool.acquire(static_cast<std::int64_t>(this->Capacity));
    this->Data = static_cast<std::byte*>(allocate(this->Capacity));
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
      this->isMapped() ? void(::munmap(this->Data, this->Capacity)) : std::free(this->Data);
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
  /** The first `count` values of a type. */
  template <class T>
  std::span<T> values(std::int64_t count) const
  {
    return { reinterpret_cast<T*>(this->Data), static_cast<std::size_t>(count) };
  }
  std::size_t capacity() const { return this->Capacity; }
  /** Uses the first `bytes` bytes, at most capacity(). */
  void resize(std::size_t bytes) { this->Size = bytes; }

  /** Grows to at least `bytes` bytes, accounted for in `pool`; keeps the content. */
  void grow(Pool& pool, std::size_t bytes)
  {
    if (roundedUp(bytes) <= this->Capacity)
    {
      this->Size = bytes;
      return;
    }
    if (!this->isMapped() || ThreadsAreWatched)
    {
      Buffer larger(pool, bytes);
      std::copy_n(this->Data, std::min(this->Size, bytes), larger.data());
      *this = std::move(larger);
      return;
    }
    const std::size_t more = roundedUp(bytes) - this->Capacity;
    this->Owner->acquire(static_cast<std::int64_t>(more));
    void* moved = ::mremap(this->Data, this->Capacity, this->Capacity + more, MREMAP_MAYMOVE);
    if (moved == MAP_FAILED)
    {
      this->Owner->release(static_cast<std::int64_t>(more));
      throw std::bad_alloc();
    }
    this->Data = static_cast<std::byte*>(moved);
    this->Capacity += more;
    this->Size = bytes;
  }

private:
  /** From this size on, memory is mapped, and so returned to the system at once when it is
   * released: the heap would keep it. */
  static constexpr std::size_t MappedBytes = std::size_t(32) << 10;

  /** Rounds up to whole cache lines, without overflow for huge sizes. */
  static constexpr std::size_t roundedUp(std::size_t bytes)
  {
    return bytes > SIZE_MAX - 63 ? bytes : (bytes + 63) / 64 * 64;
  }

  bool isMapped() const { return this->Capacity >= MappedBytes; }

  static void* allocate(std::size_t bytes)
  {
    if (bytes < MappedBytes)
    {
      return std::aligned_alloc(64, bytes);
    }
    void* memory = systemCalls().mmap(
      nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? nullptr : memory;
  }

  Pool* Owner = nullptr;
  std::byte* Data = nullptr;
  std::size_t Size = 0;
  std::size_t Capacity = 0;
};

/**
 * Buffers for reuse: releasing memory to the system and allocating it again costs more than reading
 * into it. A buffer that is too small is replaced by one that is slightly larger than requested,
 * for later requests.
 */
class SpareBuffers
{
public:
  explicit SpareBuffers(Pool& pool)
    : Owner(&pool)
  {
  }

  Buffer take(std::size_t bytes)
  {
    Buffer buffer;
    if (!this->Spare.empty())
    {
      buffer = std::move(this->Spare.back());
      this->Spare.pop_back();
    }
    if (buffer.capacity() < bytes)
    {
      const bool replaced = buffer.capacity() > 0;
      buffer = Buffer();
      buffer = Buffer(*this->Owner, replaced ? bytes + bytes / 8 : bytes);
    }
    buffer.resize(bytes);
    return buffer;
  }
  void give(Buffer buffer) { this->Spare.push_back(std::move(buffer)); }
  /** Moves its buffers to `others`, as long as these have fewer than `most`, and releases the
   * rest. */
  void giveTo(SpareBuffers& others, std::size_t most)
  {
    for (; !this->Spare.empty() && others.Spare.size() < most; this->Spare.pop_back())
    {
      others.give(std::move(this->Spare.back()));
    }
    this->Spare.clear();
  }
  /** Moves its buffers to `others`. */
  void giveTo(SpareBuffers& others)
  {
    for (; !this->Spare.empty(); this->Spare.pop_back())
    {
      others.give(std::move(this->Spare.back()));
    }
  }
  void clear() { this->Spare.clear(); }

private:
  Pool* Owner;
  std::vector<Buffer> Spare;
};

} // namespace smg
