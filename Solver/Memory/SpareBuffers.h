// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace smg
{

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
  /** Moves its buffers to `others`, which keep at most `most`. */
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
