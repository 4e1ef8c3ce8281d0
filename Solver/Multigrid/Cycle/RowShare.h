// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * The factor of a row in the norm of the residual, of the initial values or the best constant,
 * relative to which convergence is measured. `own` is what screening, Robin and soft conditions
 * contribute to the diagonal, and what weights of slivers have beyond those of regular cells;
 * `edges` is the sum of the magnitudes of the ordinary weights. Where `own` is larger, that
 * residual of the row is as large as `own`, and would hide all other rows: it is scaled down to
 * what ordinary edges alone would give. In [0, 1]; 0 if there are no edges.
 */
inline double commonShare(double own, double edges)
{
  return own > edges ? edges / own : 1.0;
}

/**
 * The factor of a row with this commonShare() in the norm of every residual, and in that of its
 * rounding. A condition that outweighs the edges by far is met by a sweep up to rounding; but that
 * rounding is relative to the condition, and would hide what is left to do in all other rows.
 */
inline double residualShare(double commonShare)
{
  constexpr double Stiff = 1e-6;
  return commonShare < Stiff ? commonShare : 1.0;
}

} // namespace smg
