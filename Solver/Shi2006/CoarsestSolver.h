// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"
#include "smg/Export.h"

#include <memory>

namespace smg::shi2006
{

/**
 * The direct solve on the coarsest level: CHOLMOD's simplicial LDL^T, factorised once. One node of
 * each connected part without alpha is held at zero; what such a part cannot answer of b, its mean,
 * is left out. There are such parts even where every component of the mesh is constrained: lifting
 * may tear a component.
 */
class SMG_EXPORT CoarsestSolver
{
public:
  CoarsestSolver();
  ~CoarsestSolver();

  /** Throws Error if the factorisation meets a zero pivot. */
  void factorize(const Level& level);
  /** Connected parts without alpha. */
  std::int64_t floatingParts() const;
  /** v = A^-1 b on the level that was factorised. */
  void solve(Level& level) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg::shi2006
