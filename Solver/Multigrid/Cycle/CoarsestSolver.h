// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "smg/Export.h"

#include <memory>

namespace smg
{

/**
 * The direct solve on the coarsest level, by a CoarsestFactor that is computed once. In each
 * component without a constraint (zero row sums) one node is pinned to zero, since its correction
 * is determined only up to a constant, which is arbitrary; the mean of b over such a component,
 * which lies outside the range of the matrix, is omitted.
 */
class SMG_EXPORT CoarsestSolver
{
public:
  CoarsestSolver();
  ~CoarsestSolver();
  CoarsestSolver(CoarsestSolver&& other) noexcept;
  CoarsestSolver& operator=(CoarsestSolver&& other) noexcept;

  /** Throws Error: see CoarsestFactor. */
  void factorize(LevelWindow<float>& level);
  /** x = A^-1 b on the factorised level, in the precision of its weights. */
  void solve(LevelWindow<float>& level) const;
  /** The same by a symmetric matrix: the constants of components without a constraint are those
   * with which x has mean 0 there. */
  void solveSymmetric(LevelWindow<float>& level) const;

private:
  void solve(LevelWindow<float>& level, bool isSymmetric) const;

  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
