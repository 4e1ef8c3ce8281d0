// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Pool.h"
#include "smg/Export.h"

#include <cstddef>

namespace smg
{

/**
 * Memory that appears three times in a row: what runs over an end of the middle image continues at
 * the other end. So what lies around a place of a ring buffer in it is reached without wrap test.
 * A page counts as resident once for each image in which it was touched: whoever stays in the
 * middle one, but for what runs over its ends, has most of them counted once.
 */
class SMG_EXPORT MirroredMemory
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

  /** The middle image. */
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
