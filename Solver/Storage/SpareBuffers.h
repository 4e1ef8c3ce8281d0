// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Buffer.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Buffers that are used again: memory that is given back to the system and asked for anew costs
 * more than what is read into it. They have a little more room than was asked for, to serve the
 * next time, too.
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
      buffer = Buffer();
      buffer = Buffer(*this->Owner, bytes + bytes / 8);
    }
    buffer.resize(bytes);
    return buffer;
  }
  void give(Buffer buffer) { this->Spare.push_back(std::move(buffer)); }
  void clear() { this->Spare.clear(); }

private:
  Pool* Owner;
  std::vector<Buffer> Spare;
};

} // namespace smg
