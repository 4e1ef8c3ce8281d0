// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Benchmarks/Shi2006/Level.h"

#include <functional>
#include <memory>
#include <vector>

namespace smg::shi2006
{

/**
 * The direct solve on the coarsest level: CHOLMOD's simplicial LDL^T, factorised once. One node of
 * each connected part without alpha is pinned to zero, and the mean of b over it, which is outside
 * the range of the matrix, is omitted. Such parts occur even if every component of the mesh is
 * constrained, since lifting may disconnect a component.
 */
class CoarsestSolver
{
public:
  CoarsestSolver();
  ~CoarsestSolver();

  /** The factor is accounted for in `pool`. Throws Error above its limit, or if the factorisation
   * encounters a zero pivot. */
  void factorize(const Level& level, Pool& pool);
  /** The number of connected parts without alpha. */
  std::int64_t floatingParts() const;
  /** v = A^-1 b on the factorised level. */
  void solve(Level& level) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg::shi2006

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
