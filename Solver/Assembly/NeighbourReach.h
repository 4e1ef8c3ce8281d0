// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"

#include <algorithm>
#include <cstdint>

namespace smg
{

/** Tracks the vertices whose neighbours are all final: no later row needs their data. */
class NeighbourReach
{
public:
  explicit NeighbourReach(Pool& pool)
    : Reach(pool)
  {
  }

  /** Declares vertex i, the next one, final; `last` is its largest neighbour, or i. */
  void close(std::int64_t i, std::int64_t last)
  {
    this->Last = std::max(this->Last, last);
    this->Reach.extendRaw(i + 1);
    this->Reach[i] = this->Last;
  }

  /** The largest neighbour of vertices 0 .. i, for i final and not done. */
  std::int64_t operator[](std::int64_t i) const { return this->Reach[i]; }

  /** Returns the end of the vertices that are done, given that those below `final` are final. */
  std::int64_t advance(std::int64_t final)
  {
    while (this->Done < final && this->Reach[this->Done] < final)
    {
      ++this->Done;
    }
    this->Reach.release(this->Done);
    return this->Done;
  }

private:
  Ring<std::int64_t> Reach;
  std::int64_t Last = 0, Done = 0;
};

} // namespace smg
