// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"
#include "smg/Export.h"

#include <memory>

namespace smg::shi2006
{

/**
 * The direct solve on the coarsest level: CHOLMOD's simplicial LDL^T, factorised once. One node of
 * each connected part without alpha is pinned to zero, and the mean of b over it, which is outside
 * the range of the matrix, is omitted. Such parts occur even if every component of the mesh is
 * constrained, since lifting may disconnect a component.
 */
class SMG_EXPORT CoarsestSolver
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
