// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/CellWeights.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** A cell that connects its corners, with the weights of its edges, which are 0 if it is flat. */
struct WeighedCell
{
  std::int64_t corners[4]; ///< 3 of a triangle
  CellWeights weights;
  double scale; ///< see WeightPolicy::scale()
};

/** Consecutive cells of a mesh stream that connect their corners. */
struct WeighedCells
{
  std::vector<WeighedCell> cells;
  std::int64_t vertices = 0;  ///< the end of those that the stream has had so far
  std::int64_t finalized = 0; ///< no later cell uses a vertex below

  /** Forgets all. */
  void clear()
  {
    this->cells.clear();
    this->vertices = this->finalized = 0;
  }
};

} // namespace smg
