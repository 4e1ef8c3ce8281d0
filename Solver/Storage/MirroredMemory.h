// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Pool.h"

#include <cstddef>

namespace smg
{

/**
 * Memory that appears twice, the second image right behind the first: what runs over the end of the
 * first image continues at its beginning. A ring buffer in it needs no wrap test.
 */
class MirroredMemory
{
public:
  static constexpr std::size_t PageBytes = 4096;

  explicit MirroredMemory(Pool& pool)
    : Owner(&pool)
  {
  }
  ~MirroredMemory() { this->clear(); }
  MirroredMemory(MirroredMemory&& other) noexcept;
  MirroredMemory& operator=(MirroredMemory&& other) noexcept;

  std::byte* data() const { return this->Data; }
  std::size_t size() const { return this->Size; }

  /**
   * Grows to `bytes`, a multiple of PageBytes. The contents keep their offsets; the address may
   * change. Throws Error.
   */
  void grow(std::size_t bytes);
  void clear();

private:
  void map(std::size_t bytes);
  void unmap();

  Pool* Owner;
  std::byte* Data = nullptr;
  std::size_t Size = 0;
  int Descriptor = -1;
};

} // namespace smg
