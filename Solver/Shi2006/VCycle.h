// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/CoarsestSolver.h"
#include "Solver/Shi2006/Level.h"

#include <functional>
#include <memory>
#include <vector>

namespace smg::shi2006
{

/** The paper's hierarchy of a finest level, and its V-cycle, level by level in memory. */
class VCycle
{
public:
  /** Told what share of a V-cycle is done; may throw. */
  using StepDone = std::function<void(double)>;

  /**
   * Builds the coarser levels of `finest`, which has edges, weights and alpha: one at least, then
   * until a level has at most `coarsestNodes` nodes, or more than four fifths of the one before:
   * its nodes have hardly any edges.
   */
  VCycle(Pool& pool, Level& finest, int sweeps, std::int64_t coarsestNodes = 1000);

  /** One V-cycle on the finest level's values. */
  void run(const StepDone& stepDone = [](double) {}) { this->run(0, stepDone); }

  /** Level `l`, 0 the finest. */
  const Level& level(std::size_t l) const { return l == 0 ? this->Finest : *this->Coarse[l - 1]; }
  std::size_t levels() const { return this->Coarse.size() + 1; }
  /**
   * Parts of the hierarchy that no constraint reaches. If there are more than components without
   * constraint, lifting has torn some.
   */
  std::int64_t detachedParts() const;

private:
  Level& at(std::size_t l) { return l == 0 ? this->Finest : *this->Coarse[l - 1]; }
  void run(std::size_t l, const StepDone& stepDone);
  void relaxLevel(std::size_t l, const StepDone& stepDone, double begin);

  Level& Finest;
  std::vector<std::unique_ptr<Level>> Coarse; // level 1, 2, ...
  CoarsestSolver Coarsest;
  int Sweeps;
};

} // namespace smg::shi2006
