// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/Level.h"

#include <algorithm>

// The stages of a level. Each moves its cursor as far as the rule at Level allows.
//
// The upward part, which finishes a V-cycle, works by demand: load() asks for nodes of the finest
// level, and asks the stages before, and through prolongation the coarser levels, for what these
// nodes need. Nothing is loaded before it is needed, which keeps the windows of the coarse levels
// short. The downward part, which begins the next V-cycle, follows as soon as it can.

namespace smg
{

template <class Real>
void Level<Real>::relax(
  std::int64_t begin, std::int64_t end, State& state, bool relaxesPatches, SweepKind sweep)
{
  const PatchRelaxation<Real> patches(this->Window, state.x, state.b);
  while (begin < end)
  {
    const BlockPart<Real> part = this->Window.partFrom(begin, end, state);
    this->Relax(part, relaxesPatches ? &patches : nullptr, sweep);
    begin = part.block.end();
  }
}

template <class Real>
void Level<Real>::relaxUpBackward()
{
  LevelWindow<Real>& window = this->Window;
  const PatchRelaxation<Real> patches(window, window.x(), window.b());
  for (std::size_t s = this->sweeps(); s-- > 0;)
  {
    for (std::int64_t end = window.nodes(); end > 0;)
    {
      const std::int64_t begin = (end - 1) / RowBlock::Nodes * RowBlock::Nodes;
      this->Relax(
        window.partFrom(begin, end, window.up()), s == 0 ? &patches : nullptr, SweepKind::Backward);
      end = begin;
    }
  }
}

/** Asks the last sweep for node `node`, and if that sweep relaxes patches, for the ends of the
 * patches around it. */
template <class Real>
void Level<Real>::load(std::int64_t node)
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
template <class Real>
std::int64_t Level<Real>::finalWith(std::int64_t node) const
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
template <class Real>
void Level<Real>::load(int stage, std::int64_t node)
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

template <class Real>
void Level<Real>::prolong(bool follows)
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
  this->Window.forColumns(begin, end, this->Window.up(), this->prolongation());
  this->At.prolonged = end;
}

template <class Real>
void Level<Real>::postSweep(std::size_t s, bool follows)
{
  Cursor& cursor = this->At.postSweep[s];
  const std::int64_t ready =
    s == 0 ? this->Window.reachable(cursor, this->At.prolonged.seen(follows), false)
           : this->reachable(cursor, this->At.postSweep, s - 1, follows);
  const std::int64_t end = std::min(ready, this->At.wanted[s + 1]);
  this->relax(cursor, end, this->Window.up(), s == 0, SweepKind::Forward);
  cursor = end;
}

template <class Real>
void Level<Real>::preSweep(std::size_t s, bool follows)
{
  Cursor& cursor = this->At.preSweep[s];
  const std::int64_t end = s == 0 ? this->firstPreSweepEnd(follows)
                                  : this->reachable(cursor, this->At.preSweep, s - 1, follows);
  // On coarse levels x starts from zero: the first sweep reads the nodes below only, which it has
  // set itself.
  this->relax(cursor, end, this->Window.down(), s == 0,
    s == 0 && this->Fine ? SweepKind::LowerOnly : SweepKind::Forward);
  cursor = end;
}

/** The end of the nodes that the first sweep of the downward part may process. */
template <class Real>
std::int64_t Level<Real>::firstPreSweepEnd(bool follows)
{
  std::int64_t end = this->At.preSweep.front();
  if (!this->Fine)
  {
    // The first pass has no upward part: initial values are final. Later, the last sweep of the
    // upward part must have passed all neighbours, or, where another problem begins, the stage that
    // fills the new state.
    return this->First ? this->Window.loaded()
           : this->Window.isSeparate()
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
template <class Real>
void Level<Real>::combine(bool follows)
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
template <class Real>
void Level<Real>::restrict(bool follows)
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
  this->Window.forColumns(this->At.restricted, end, this->Window.down(), this->restriction());
  this->At.restricted = end;
}

/**
 * x and b of a coarse node are used by two V-cycles in one pass: first as correction of the V-cycle
 * that ends, then as residual equation of the one that begins. One pair of vectors suffices, since
 * the second use begins only when the first one has ended for the node: when the last sweep has
 * passed its neighbours, which read x, and the finer level has prolonged to all its children.
 */
template <class Real>
bool Level<Real>::prepare(std::int64_t node)
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

template class Level<double>;
template class Level<float>;

} // namespace smg
