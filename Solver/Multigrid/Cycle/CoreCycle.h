// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/CoarsestSolver.h"
#include "Solver/Multigrid/Cycle/CoreIteration.h"
#include "Solver/Multigrid/Cycle/Level.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace smg
{

/**
 * The part of a V-cycle on the levels in memory (core levels), performed between two passes. The
 * first of them that is much smaller than the finest level is solved by a CoreIteration, unless it
 * is the coarsest one.
 */
template <class Relaxation>
class CoreCycle
{
public:
  using CoreLevel = Level<float, Relaxation>;

  /** `levels` from the finest core level to the coarsest one; `finest`: the number of nodes of the
   * finest level; 0: none is iterated. */
  void setLevels(std::vector<CoreLevel*> levels, std::int64_t finest)
  {
    this->Levels = std::move(levels);
    const auto isSmall = [finest](CoreLevel* level)
    { return level->window().nodes() <= finest / SmallShare; };
    this->Iterated = static_cast<std::size_t>(
      std::find_if(this->Levels.begin(), this->Levels.end(), isSmall) - this->Levels.begin());
    this->Coarsest.factorize(this->Levels.back()->window());
  }

  /** Computes x of the finest core level from its b, which may be lost. */
  void run() { this->solve(0); }

private:
  /** A level with this share of the finest level's nodes is much smaller. */
  static constexpr std::int64_t SmallShare = 128;

  /** Computes x of level l from its b. */
  void solve(std::size_t l)
  {
    if (l + 1 == this->Levels.size())
    {
      this->Coarsest.solve(this->Levels[l]->window());
    }
    else if (l == this->Iterated)
    {
      CoreIteration<Relaxation> iteration(*this->Levels[l], {});
      iteration([this, l] { this->cycle(l); });
    }
    else
    {
      this->cycle(l);
    }
  }

  /** The same by a V-cycle, on a level that is not the coarsest one. */
  void cycle(std::size_t l)
  {
    CoreLevel& level = *this->Levels[l];
    CoreLevel& coarse = *this->Levels[l + 1];
    level.relaxDown();
    coarse.window().zeroB(0, coarse.window().nodes());
    level.restrictAll();
    this->solve(l + 1);
    level.prolongAll();
    level.relaxUp();
  }

  std::vector<CoreLevel*> Levels;
  std::size_t Iterated = 0; // index of the level that is iterated
  CoarsestSolver Coarsest;
};

} // namespace smg
