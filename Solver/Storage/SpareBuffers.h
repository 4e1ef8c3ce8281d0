// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Buffers that are used again: memory that is given back to the system and asked for anew costs
 * more than what is read into it. All are as large as the largest that was asked for.
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
    this->Largest = std::max(this->Largest, bytes);
    Buffer buffer;
    if (!this->Spare.empty())
    {
      buffer = std::move(this->Spare.back());
      this->Spare.pop_back();
    }
    if (buffer.capacity() < bytes)
    {
      buffer = Buffer();
      buffer = Buffer(*this->Owner, this->Largest);
    }
    buffer.resize(bytes);
    return buffer;
  }
  void give(Buffer buffer) { this->Spare.push_back(std::move(buffer)); }
  void clear() { this->Spare.clear(); }

private:
  Pool* Owner;
  std::vector<Buffer> Spare;
  std::size_t Largest = 0;
};

} // namespace smg
