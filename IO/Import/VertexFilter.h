// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** A set of vertices, that may contain more than were added: a bit for each or, where a 32nd of the
 * memory has no room for that many words, for several. */
class VertexFilter
{
public:
  VertexFilter(Workspace& workspace, std::int64_t vertices)
    : Words(static_cast<std::size_t>(std::clamp<std::int64_t>(
        (vertices + 63) / 64, 1, std::max<std::int64_t>(workspace.available() / 32, 1))))
    , Bits(workspace.pool(), this->Words * sizeof(std::uint64_t))
  {
    std::ranges::fill(this->words(), 0);
  }

  void add(std::uint32_t vertex)
  {
    this->words()[vertex / 64 % this->Words] |= std::uint64_t(1) << vertex % 64;
  }
  bool has(std::uint32_t vertex) const
  {
    return (this->words()[vertex / 64 % this->Words] >> vertex % 64 & 1) != 0;
  }

private:
  std::span<std::uint64_t> words() const
  {
    return { reinterpret_cast<std::uint64_t*>(this->Bits.data()), this->Words };
  }

  std::size_t Words;
  Buffer Bits;
};

} // namespace smg
