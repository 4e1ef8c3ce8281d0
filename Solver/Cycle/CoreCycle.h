// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/CoarsestSolver.h"
#include "Solver/Cycle/Level.h"

#include <memory>
#include <vector>

namespace smg
{

/** The part of a V-cycle on the levels in memory (core levels), performed between two passes. */
template <class Relaxation>
class CoreCycle
{
public:
  using CoreLevel = Level<float, Relaxation>;

  /** `levels` from the finest core level to the coarsest one. */
  void setLevels(std::vector<CoreLevel*> levels)
  {
    this->Levels = std::move(levels);
    this->Coarsest.factorize(this->Levels.back()->window());
  }

  /** Computes x of the finest core level from its b. */
  void run() { this->cycle(0); }

private:
  void cycle(std::size_t l)
  {
    CoreLevel& level = *this->Levels[l];
    if (l + 1 == this->Levels.size())
    {
      this->Coarsest.solve(level.window());
      return;
    }
    CoreLevel& coarse = *this->Levels[l + 1];
    level.relaxDown();
    coarse.window().zeroB(0, coarse.window().nodes());
    level.restrictAll();
    this->cycle(l + 1);
    level.prolongAll();
    level.relaxUp();
  }

  std::vector<CoreLevel*> Levels;
  CoarsestSolver Coarsest;
};

} // namespace smg
