// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "smg/Export.h"

#include <memory>

namespace smg
{

/**
 * The direct solve on the coarsest level, with a CoarsestFactor that is computed once. One node of
 * each unconstrained component (with zero row sums) is pinned to zero: its correction is determined
 * up to a constant, which is arbitrary. The part of b outside the range of the matrix, the mean
 * over such a component, is omitted.
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

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
