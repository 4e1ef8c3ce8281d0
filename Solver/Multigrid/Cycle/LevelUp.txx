// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Level.h"

// The stages of the upward part, which finishes a V-cycle: prolongation and post-smoothing. It
// works by demand: load() asks for nodes of the finest level, and asks the stages before, and
// through prolongation the coarser levels, for what these nodes need. Nothing is loaded before it
// is needed, which keeps the windows of the coarse levels short.

namespace smg
{

template <class Real, class Relaxation>
void Level<Real, Relaxation>::addUpward(Schedule& schedule)
{
  if (this->Core)
  {
    return;
  }
  this->Coarse->addUpward(schedule);
  const int level = this->Window.index();
  const auto nodes = static_cast<double>(this->Window.nodes());
  schedule.add({ "prolong the correction", level, ProlongCost * nodes,
    [this](bool follows) { this->prolongUp(follows); } });
  for (std::size_t s = 0; s < this->At.postSweep.size(); ++s)
  {
    schedule.add({ "relax after prolongation", level, nodes,
      [this, s](bool follows) { this->postSweep(s, follows); } });
  }
}

/** Asks the last sweep for node `node`, and if that sweep relaxes patches, for the ends of the
 * patches around it. */
template <class Real, class Relaxation>
void Level<Real, Relaxation>::load(std::int64_t node)
{
  const int last = static_cast<int>(this->At.postSweep.size());
  this->load(last, node);
  this->load(last, this->finalWith(node));
  if (this->History)
  {
    this->History->load(this->Window.loaded());
  }
}

/** The node that the last sweep of the upward part must reach for x of nodes 0 .. node to be
 * final, given that these are loaded: if that sweep relaxes patches, the end of a patch still
 * changes its other members. On the finest level this may wait for later steps, and it is
 * `node` itself. */
template <class Real, class Relaxation>
std::int64_t Level<Real, Relaxation>::finalWith(std::int64_t node) const
{
  if (!this->endPatched() || !this->Fine || this->Core || node < this->Window.first())
  {
    return node;
  }
  const RowBlock::Header& h = this->Window.header(node);
  return h.reach(LevelWindow<Real>::groupIn(h, node), true);
}

/** Asks stage `stage` of the upward part (0: prolongation) to process node `node`, and loads all
 * that it needs, backwards through the stages. */
template <class Real, class Relaxation>
void Level<Real, Relaxation>::load(int stage, std::int64_t node)
{
  std::int64_t& wanted = this->At.wanted[static_cast<std::size_t>(stage)];
  // Already asked for: the recursion ends here, so its cost is one visit per group and stage.
  if (this->Core || wanted > node)
  {
    return;
  }
  this->Window.load(node);
  const RowBlock::Header& h = this->Window.header(node);
  const auto g = LevelWindow<Real>::groupIn(h, node);
  wanted = LevelWindow<Real>::groupEnd(h, node);
  if (stage == 0)
  {
    this->Coarse->load(h.parentReach[g]);
  }
  else
  {
    // Stage 1 is the first sweep, which relaxes patches: behind it, stage 2 needs the patches to be
    // complete.
    this->load(stage - 1, h.reach(g, stage == 2 && this->Patched));
  }
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::prolongUp(bool follows)
{
  // The first stage of the level: makes the loaded state available to those behind it.
  this->Window.unpack();
  if (this->History)
  {
    this->History->keep(this->Window.x());
  }
  const std::int64_t begin = this->At.prolonged;
  std::int64_t end = begin;
  while (end < this->At.wanted.front())
  {
    const RowBlock::Header& h = this->Window.header(end);
    // Groups have the largest parent of all rows so far, so a group is ready when that parent is.
    if (!this->Coarse->isFinal(h.parentReach[LevelWindow<Real>::groupIn(h, end)], follows))
    {
      break;
    }
    end = LevelWindow<Real>::groupEnd(h, end);
  }
  this->prolongTo(begin, end);
  this->At.prolonged = end;
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::postSweep(std::size_t s, bool follows)
{
  Cursor& cursor = this->At.postSweep[s];
  const std::int64_t ready =
    s == 0 ? this->Window.reachable(cursor, this->At.prolonged.seen(follows), false)
           : this->reachable(cursor, this->At.postSweep, s - 1, follows);
  const std::int64_t end = std::min(ready, this->At.wanted[s + 1]);
  this->sweep<false>(cursor, end, this->Window.up(), s == 0);
  cursor = end;
}

} // namespace smg
