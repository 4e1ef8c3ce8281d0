// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/CoarsestSolver.h"
#include "Solver/Shi2006/Level.h"

#include <functional>
#include <memory>
#include <vector>

namespace smg::shi2006
{

/** The hierarchy of the paper for a finest level, and its V-cycle, level by level in memory. */
class VCycle
{
public:
  /** Receives the completed share of a V-cycle; may throw. */
  using StepDone = std::function<void(double)>;

  /**
   * Builds the coarser levels of `finest`, which has edges, weights and alpha: at least one, until
   * a level has at most `coarsestNodes` nodes, or more than four fifths of the nodes of the
   * previous one, because its nodes have hardly any edges.
   */
  VCycle(Pool& pool, Level& finest, int sweeps, std::int64_t coarsestNodes = 1000);

  /** Performs one V-cycle on the values of the finest level. */
  void run(const StepDone& stepDone = [](double) {}) { this->run(0, stepDone); }

  /** Level `l`, 0 the finest. */
  const Level& level(std::size_t l) const { return l == 0 ? this->Finest : *this->Coarse[l - 1]; }
  std::size_t levels() const { return this->Coarse.size() + 1; }
  /** The number of unconstrained parts of the hierarchy. If there are more than unconstrained
   * components, lifting has disconnected some. */
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
