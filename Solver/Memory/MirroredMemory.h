// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "smg/Export.h"

#include <cstddef>

namespace smg
{

/**
 * Memory that is mapped three times in a row: accesses beyond an end of the middle image wrap
 * around to the other end, so that the neighbourhood of an item of a ring buffer is accessed
 * without a wrap test. A page counts as resident once for each image in which it is touched:
 * accesses should start in the middle image, so that most pages count once.
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

  /** Grows to `bytes`, a multiple of PageBytes. The content keeps its offsets; the address may
   * change. Throws Error. */
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
