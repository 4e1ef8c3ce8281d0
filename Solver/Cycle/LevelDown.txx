// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/Level.h"

// The stages of the downward part: the sweeps that begin a V-cycle, acceleration, restriction.

namespace smg
{

template <class Real, class Relaxation>
void Level<Real, Relaxation>::preSweep()
{
  std::vector<std::int64_t>& sweep = this->At.preSweep;
  const std::int64_t first = this->firstPreSweepEnd();
  if (this->Fine)
  {
    this->sweep<true>(sweep[0], first, this->Window.down());
  }
  else
  {
    this->sweep<false>(sweep[0], first, this->Window.down());
  }
  sweep[0] = first;
  for (std::size_t s = 1; s < sweep.size(); ++s)
  {
    const std::int64_t end = this->Window.reachable(sweep[s], sweep[s - 1]);
    this->sweep<false>(sweep[s], end, this->Window.down());
    sweep[s] = end;
  }
}

/** The end of the nodes that the first sweep of the downward part may process. */
template <class Real, class Relaxation>
std::int64_t Level<Real, Relaxation>::firstPreSweepEnd()
{
  std::int64_t end = this->At.preSweep[0];
  if (!this->Fine)
  {
    return this->First      ? this->Window.loaded()
           : this->Renewing ? this->Renewed
                            : this->Window.reachable(end, this->At.seenPostSwept);
  }
  // b must be complete; the upper neighbours are zero, so they need not be loaded.
  while (end < this->Window.loaded())
  {
    const RowBlock::Header& h = this->Window.header(end);
    if (this->Fine->restricted <= h.childReach[LevelWindow<Real>::groupIn(h, end)])
    {
      break;
    }
    end = LevelWindow<Real>::groupEnd(h, end);
  }
  return end;
}

/** Acceleration may modify a node when no sweep reads it any more. */
template <class Real, class Relaxation>
void Level<Real, Relaxation>::combine()
{
  std::int64_t end = this->At.preSweep.back();
  if (this->History)
  {
    end = this->Window.reachable(this->At.combined, end);
    this->History->combine(this->Window.x(), this->At.combined, end);
  }
  this->At.combined = end;
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::restrictDown()
{
  const std::int64_t limit = this->Window.reachable(this->At.restricted, this->At.combined);
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

template <class Real, class Relaxation>
bool Level<Real, Relaxation>::prepare(std::int64_t node)
{
  if (this->First)
  {
    this->Window.extendB(node + 1);
  }
  if (this->First || this->Core)
  {
    return true;
  }
  while (this->At.reset <= node)
  {
    const RowBlock::Header& h = this->Window.header(this->At.reset);
    const auto g = LevelWindow<Real>::groupIn(h, this->At.reset);
    if (this->At.seenPostSwept <= h.neighbourReach[g] ||
        this->Fine->seenProlonged <= h.childReach[g])
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
