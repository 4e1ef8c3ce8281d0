// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/LevelWindow.h"
#include "smg/Export.h"

#include <memory>

namespace smg
{

/**
 * The direct solve on the coarsest level: by a CoarsestFactor, made once. One node of
 * each connected component whose row sums vanish (no constraint reaches it) is held at zero: there
 * the correction is determined up to a constant, and any will do. What such a component cannot
 * answer of b, its mean, is left out.
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
  /** x = A^-1 b on the level that was factorised, as precisely as its weights are. */
  void solve(LevelWindow<float>& level) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
