// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Level.h"

// The stages of the downward part, which begins a V-cycle: pre-smoothing, acceleration, residual
// and restriction. Each stage moves its cursor as far as the rule at Level allows. Stages of the
// finest level come first; each level follows the one that restricts to it.

namespace smg
{

template <class Real, class Relaxation>
void Level<Real, Relaxation>::addDownward(Schedule& schedule)
{
  if (this->Core)
  {
    return;
  }
  const int level = this->Window.index();
  const auto nodes = static_cast<double>(this->Window.nodes());
  for (std::size_t s = 0; s < this->At.preSweep.size(); ++s)
  {
    schedule.add({ "relax before restriction", level, nodes,
      [this, s](bool follows) { this->preSweep(s, follows); } });
  }
  // Without a history the stage only passes the cursor on.
  schedule.add({ "combine iterates", level, this->History ? CombineCost * nodes : 0.0,
    [this](bool follows) { this->combine(follows); } });
  schedule.add({ "restrict the residual", level, RestrictCost * nodes,
    [this](bool follows) { this->restrictDown(follows); } });
  this->Coarse->addDownward(schedule);
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::preSweep(std::size_t s, bool follows)
{
  Cursor& cursor = this->At.preSweep[s];
  const std::int64_t end = s == 0 ? this->firstPreSweepEnd(follows)
                                  : this->reachable(cursor, this->At.preSweep, s - 1, follows);
  // On coarse levels x starts from zero: the first sweep reads the nodes below only, which it has
  // set itself.
  if (s == 0 && this->Fine)
  {
    this->sweep<true>(cursor, end, this->Window.down(), true);
  }
  else
  {
    this->sweep<false>(cursor, end, this->Window.down(), s == 0);
  }
  cursor = end;
}

/** The end of the nodes that the first sweep of the downward part may process. */
template <class Real, class Relaxation>
std::int64_t Level<Real, Relaxation>::firstPreSweepEnd(bool follows)
{
  std::int64_t end = this->At.preSweep.front();
  if (!this->Fine)
  {
    // The first pass has no upward part: initial values are final. Later, the last sweep of the
    // upward part must have passed all neighbours, or, where another problem begins, the stage that
    // fills the new state.
    return this->First ? this->Window.loaded()
           : this->Window.isApart()
             ? this->At.renewed.seen(follows)
             : this->reachable(end, this->At.postSweep, this->At.postSweep.size() - 1, follows);
  }
  // b must be complete: restriction has passed the last child of the group. The upper neighbours
  // count as zero, so they need not be loaded.
  const std::int64_t restricted = this->Fine->restricted.seen(follows);
  while (end < this->Window.loaded())
  {
    const RowBlock::Header& h = this->Window.header(end);
    if (restricted <= h.childReach[LevelWindow<Real>::groupIn(h, end)])
    {
      break;
    }
    end = LevelWindow<Real>::groupEnd(h, end);
  }
  return end;
}

/** Acceleration may modify a node once no sweep reads it any more. Restriction then takes the
 * residual of the accelerated iterate. */
template <class Real, class Relaxation>
void Level<Real, Relaxation>::combine(bool follows)
{
  std::int64_t end = this->At.preSweep.back().seen(follows);
  if (this->History)
  {
    end =
      this->reachable(this->At.combined, this->At.preSweep, this->At.preSweep.size() - 1, follows);
    this->History->combine(this->Window.x(), this->At.combined, end);
  }
  this->At.combined = end;
}

/** Restricts as far as the last stage has passed all neighbours, and as far as the coarse level
 * can take it: its b must have been set to zero. */
template <class Real, class Relaxation>
void Level<Real, Relaxation>::restrictDown(bool follows)
{
  const std::int64_t limit = this->Window.reachable(
    this->At.restricted, this->At.combined.seen(follows), this->endPatched());
  std::int64_t end = this->At.restricted;
  while (end < limit)
  {
    const RowBlock::Header& h = this->Window.header(end);
    if (!this->Coarse->prepare(h.parentReach[LevelWindow<Real>::groupIn(h, end)]))
    {
      break;
    }
    end = LevelWindow<Real>::groupEnd(h, end);
  }
  this->restrictTo(end);
  this->At.restricted = end;
}

/**
 * x and b of a coarse node are used by two V-cycles in one pass: first as correction of the V-cycle
 * that ends, then as residual equation of the one that begins. One pair of vectors suffices, since
 * the second use begins only when the first one has ended for the node: when the last sweep has
 * passed its neighbours, which read x, and the finer level has prolongated to all its children.
 */
template <class Real, class Relaxation>
bool Level<Real, Relaxation>::prepare(std::int64_t node)
{
  if (this->First || this->Core)
  {
    return true;
  }
  while (this->At.reset <= node)
  {
    const RowBlock::Header& h = this->Window.header(this->At.reset);
    const auto g = LevelWindow<Real>::groupIn(h, this->At.reset);
    // Published cursors, since these stages may run on other threads at this time.
    if (this->At.postSweep.back().published() <= h.reach(g, this->endPatched()) ||
        this->Fine->prolonged.published() <= h.childReach[g])
    {
      return false;
    }
    const std::int64_t end = LevelWindow<Real>::groupEnd(h, this->At.reset);
    this->Window.zeroB(this->At.reset, end);
    this->At.reset = end;
  }
  return true;
}

} // namespace smg
