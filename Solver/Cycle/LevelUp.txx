// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/Level.h"

// The stages of the upward part: prolongation and the sweeps that finish a V-cycle.

namespace smg
{

template <class Real, class Relaxation>
void Level<Real, Relaxation>::load(std::int64_t node)
{
  const int last = static_cast<int>(this->At.postSweep.size());
  this->load(last, node);
  this->load(last, this->finalWith(node));
  if (this->History)
  {
    this->History->load(this->Window.x(), this->Window.loaded());
  }
}

/**
 * The node that the last sweep of the upward part must reach for x of the loaded nodes 0 .. node to
 * be final: the last node of a patch changes the others, all within a ring. The finest level may
 * defer this to later steps.
 */
template <class Real, class Relaxation>
std::int64_t Level<Real, Relaxation>::finalWith(std::int64_t node) const
{
  if (!this->Patched || !this->Fine || this->Core || node < this->Window.first())
  {
    return node;
  }
  const RowBlock::Header& h = this->Window.header(node);
  return h.neighbourReach[LevelWindow<Real>::groupIn(h, node)];
}

/** Follows the upward part to stage `stage` of node `node` like pull(), and loads. */
template <class Real, class Relaxation>
void Level<Real, Relaxation>::load(int stage, std::int64_t node)
{
  if (this->Core || node < 0 || upCursor(this->At, stage) > node)
  {
    return;
  }
  this->Window.load(node);
  const RowBlock::Header& h = this->Window.header(node);
  const auto g = LevelWindow<Real>::groupIn(h, node);
  if (stage == 0)
  {
    this->Coarse->load(h.parentReach[g]);
  }
  else
  {
    this->load(stage - 1, h.neighbourReach[g]);
  }
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::pull(int stage, std::int64_t node)
{
  std::int64_t& cursor = upCursor(this->At, stage);
  if (this->Core || cursor > node)
  {
    return;
  }
  const RowBlock::Header& h = this->Window.header(node);
  const auto g = LevelWindow<Real>::groupIn(h, node);
  const std::int64_t end = LevelWindow<Real>::groupEnd(h, node);
  if (stage == 0)
  {
    this->Coarse->pull(h.parentReach[g]);
    this->prolongTo(cursor, end);
  }
  else
  {
    this->pull(stage - 1, h.neighbourReach[g]);
    this->sweep<false>(cursor, end, this->Window.up());
  }
  cursor = end;
}

} // namespace smg
