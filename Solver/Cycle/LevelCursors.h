// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace smg
{

/** The number of nodes of all levels in memory, and its maximum. */
struct ResidentNodes
{
  std::int64_t current = 0;
  std::int64_t peak = 0;

  void add(std::int64_t nodes)
  {
    this->current += nodes;
    this->peak = std::max(this->peak, this->current);
  }
};

/**
 * The cursors of a level in a pass: for each stage the next node to process. The upward part
 * (prolongation and post-smoothing) finishes a V-cycle, the downward part (pre-smoothing, residual
 * and restriction) begins the next one. Both are performed in one pass, the downward part behind
 * the upward part.
 */
struct LevelCursors
{
  std::int64_t prolonged = 0;          ///< x += P x_coarse
  std::vector<std::int64_t> postSweep; ///< sweeps after prolongation
  std::int64_t reset = 0;              ///< b set to zero for the next V-cycle (coarse levels)
  std::vector<std::int64_t> preSweep;  ///< sweeps before restriction
  std::int64_t combined = 0;           ///< acceleration (finest level)
  std::int64_t restricted = 0;         ///< residual and restriction

  /** Cursors of the upward part as seen by the downward part, which may run on another thread. */
  std::int64_t seenProlonged = 0, seenPostSwept = 0;
  std::int64_t finishedUp = 0; ///< nodes below have finished the upward part
  /** Cursors of the downward part as seen by the writer. */
  std::int64_t seenFinal = 0, seenRestricted = 0;

  explicit LevelCursors(int sweeps)
    : postSweep(static_cast<std::size_t>(sweeps))
    , preSweep(static_cast<std::size_t>(sweeps))
  {
  }

  void rewind()
  {
    const auto sweeps = static_cast<int>(this->postSweep.size());
    *this = LevelCursors(sweeps);
  }
};

} // namespace smg
