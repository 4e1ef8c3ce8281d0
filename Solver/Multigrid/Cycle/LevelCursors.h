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
 * The next node that a stage processes: the stage has finished those below. Stages on other threads
 * see the node that show() has shown them between two steps of a pass; so what they may process,
 * and with it the memory of the pass, does not depend on the progress of this one's thread.
 */
class Cursor
{
public:
  Cursor& operator=(std::int64_t node)
  {
    this->Node = node;
    return *this;
  }
  /** The node, for the stage itself. */
  operator std::int64_t() const { return this->Node; }
  /** The node, for a stage that `follows` this one on the same thread, or does not. */
  std::int64_t seen(bool follows) const { return follows ? this->Node : this->Shown; }
  /** The node, for a stage on another thread. */
  std::int64_t shown() const { return this->Shown; }
  void show() { this->Shown = this->Node; }

private:
  std::int64_t Node = 0;
  std::int64_t Shown = 0;
};

/**
 * The cursors of a level in a pass: for each stage the next node to process. The upward part
 * (prolongation and post-smoothing) finishes a V-cycle, the downward part (pre-smoothing, residual
 * and restriction) begins the next one. Both are performed in one pass, the downward part behind
 * the upward part.
 */
struct LevelCursors
{
  Cursor prolonged;              ///< x += P x_coarse
  std::vector<Cursor> postSweep; ///< sweeps after prolongation
  Cursor renewed;                ///< the downward part has its own state (finest level)
  std::int64_t reset = 0;        ///< b set to zero for the next V-cycle (coarse levels)
  std::vector<Cursor> preSweep;  ///< sweeps before restriction
  Cursor combined;               ///< acceleration (finest level)
  Cursor restricted;             ///< residual and restriction

  /** The end of the nodes that the stages of the upward part, prolongation first, are to process:
   * what is loaded suffices for it. */
  std::vector<std::int64_t> wanted;

  explicit LevelCursors(int sweeps)
    : postSweep(static_cast<std::size_t>(sweeps))
    , preSweep(static_cast<std::size_t>(sweeps))
    , wanted(static_cast<std::size_t>(sweeps) + 1)
  {
  }

  /** Shows all of them to the stages on other threads, in between. */
  void show()
  {
    for (Cursor* cursor : { &this->prolonged, &this->renewed, &this->combined, &this->restricted })
    {
      cursor->show();
    }
    std::ranges::for_each(this->postSweep, &Cursor::show);
    std::ranges::for_each(this->preSweep, &Cursor::show);
  }

  void rewind()
  {
    const auto sweeps = static_cast<int>(this->postSweep.size());
    *this = LevelCursors(sweeps);
  }
};

} // namespace smg
