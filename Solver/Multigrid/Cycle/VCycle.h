// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/CoarsestSolver.h"
#include "Solver/Multigrid/Cycle/CoreIteration.h"
#include "Solver/Multigrid/Cycle/Level.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

// The V-cycle. On the levels in memory (core levels) it is the recursion that textbooks have:
// CoreVCycle::cycle(), at the end. On the streamed levels the same steps are stages that follow
// each other through the stream: addDownward() declares those that begin a V-cycle, from the finest
// level to the coarsest streamed one, addUpward() those that finish it, in the opposite direction.
// Between the two parts lies CoreVCycle::run(). A pass (Engine/Pass.h) performs the upward part of
// one V-cycle and behind it the downward part of the next one.
//
// Where things are: relaxation in GaussSeidel.h and, with patches, Sweep.h; prolongation and
// restriction in Transfer.h; how far a stage may go in LevelStages.cpp.

namespace smg
{

/** The time that a stage takes per node, relative to a sweep: used to cut a schedule into chains.
 */
inline constexpr double ProlongCost = 0.8, CombineCost = 0.5, RestrictCost = 1.4;

/** Adds the stages that begin a V-cycle, on this and the coarser streamed levels. */
template <class Real>
void addDownward(Level<Real>& level, Schedule& schedule)
{
  using Stages = Level<Real>;
  if (level.core())
  {
    return;
  }
  const int index = level.window().index();
  const auto nodes = static_cast<double>(level.window().nodes());
  const LevelCursors& at = level.cursors();
  for (std::size_t s = 0; s < level.sweeps(); ++s)
  {
    schedule.add(
      { "relax before restriction", index, nodes, std::bind_front(&Stages::preSweep, &level, s) },
      [&at, s] { return std::int64_t(at.preSweep[s]); }, s + 1);
  }
  // Without acceleration the stage only passes the cursor on.
  schedule.add({ "combine iterates", index, level.isAccelerated() ? CombineCost * nodes : 0.0,
                 std::bind_front(&Stages::combine, &level) },
    [&at] { return std::int64_t(at.combined); });
  schedule.add({ "restrict the residual", index, RestrictCost * nodes,
                 std::bind_front(&Stages::restrict, &level) },
    [&at] { return std::int64_t(at.restricted); });
  addDownward(level.coarse(), schedule);
}

/** Adds the stages that finish a V-cycle, on the coarser streamed levels and this one. */
template <class Real>
void addUpward(Level<Real>& level, Schedule& schedule)
{
  using Stages = Level<Real>;
  if (level.core())
  {
    return;
  }
  addUpward(level.coarse(), schedule);
  const int index = level.window().index();
  const auto nodes = static_cast<double>(level.window().nodes());
  const LevelCursors& at = level.cursors();
  schedule.add({ "prolong the correction", index, ProlongCost * nodes,
                 std::bind_front(&Stages::prolong, &level) },
    [&at] { return std::int64_t(at.prolonged); });
  for (std::size_t s = 0; s < level.sweeps(); ++s)
  {
    schedule.add(
      { "relax after prolongation", index, nodes, std::bind_front(&Stages::postSweep, &level, s) },
      [&at, s] { return std::int64_t(at.postSweep[s]); }, s + 1);
  }
}

/** The part of a V-cycle on the levels in memory (core levels), performed between two passes.
 * The first of them that is much smaller than the finest level is solved by a CoreIteration,
 * unless it is the coarsest one, which is solved directly. */
class CoreVCycle
{
public:
  using CoreLevel = Level<float>;

  /** Sets the levels, from the finest core level to the coarsest one, and factorises that.
   * `finest`: the number of nodes of the finest level, to which sizes are compared; 0: none is
   * iterated. */
  void setLevels(std::vector<CoreLevel*> levels, std::int64_t finest)
  {
    this->CoreLevels = std::move(levels);
    const auto isSmall = [finest](CoreLevel* level)
    { return level->window().nodes() <= finest / SmallShare; };
    this->Iterated = static_cast<std::size_t>(
      std::find_if(this->CoreLevels.begin(), this->CoreLevels.end(), isSmall) -
      this->CoreLevels.begin());
    this->Coarsest.factorize(this->CoreLevels.back()->window());
  }

  /** Computes x of the finest core level from its b, which may be overwritten. */
  void run() { this->solve(0); }

  /** Computes x of a level from its b by a V-cycle that is linear and symmetric: its relaxation
   * ends with the transpose of that with which it begins, and no level is iterated. This and all
   * coarser levels must be in memory. */
  template <class Real>
  void symmetric(Level<Real>& level)
  {
    CoreLevel& coarse = level.coarse();
    level.relaxDown();
    coarse.window().zeroB(0, coarse.window().nodes());
    level.restrictAll();
    &coarse == this->CoreLevels.back() ? this->Coarsest.solveSymmetric(coarse.window())
                                       : this->symmetric(coarse);
    level.prolongAll();
    level.relaxUpBackward();
  }

private:
  /** A level with at most one node for this many of the finest level is much smaller. */
  static constexpr std::int64_t SmallShare = 128;

  /** Computes x of level l from its b. */
  void solve(std::size_t l)
  {
    if (l + 1 == this->CoreLevels.size())
    {
      this->Coarsest.solve(this->CoreLevels[l]->window());
    }
    else if (l == this->Iterated)
    {
      CoreIteration iteration(*this->CoreLevels[l], {});
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
    CoreLevel& level = *this->CoreLevels[l];
    CoreLevel& coarse = *this->CoreLevels[l + 1];
    level.relaxDown();
    coarse.window().zeroB(0, coarse.window().nodes());
    level.restrictAll();
    this->solve(l + 1);
    level.prolongAll();
    level.relaxUp();
  }

  std::vector<CoreLevel*> CoreLevels;
  std::size_t Iterated = 0; // index of the level that CoreIteration solves
  CoarsestSolver Coarsest;
};

} // namespace smg
