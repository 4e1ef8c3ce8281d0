// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace smg
{

/** Nodes of all levels that are in memory, and the most there have been. */
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
 * The cursors of a level in a pass: for each stage the next node that it will do. The way up
 * (prolongation, sweeps) finishes a V-cycle, the way down (sweeps, residual and restriction) begins
 * the next one; both happen in one pass, the way down behind the way up.
 */
struct LevelCursors
{
  std::int64_t prolonged = 0;          ///< x += P x_coarse
  std::vector<std::int64_t> postSweep; ///< sweeps after prolongation
  std::int64_t reset = 0;              ///< b set to zero for the next V-cycle (coarse levels)
  std::vector<std::int64_t> preSweep;  ///< sweeps before restriction
  std::int64_t combined = 0;           ///< acceleration (finest level)
  std::int64_t restricted = 0;         ///< residual and restriction

  /** Of the way up, what the way down knows: the two may run on two threads. */
  std::int64_t seenProlonged = 0, seenPostSwept = 0;
  std::int64_t finishedUp = 0; ///< of the way up, final
  /** Of the way down, what writing knows. */
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
