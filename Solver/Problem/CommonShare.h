// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * The factor of a row in the norm of the initial residual. If `own`, the contribution of screening,
 * Robin and soft conditions to the diagonal, exceeds the magnitudes of the weights of the `edges`,
 * the row determines its unknown alone and its initial residual is as large as `own`; it then
 * counts as if it had only the weight of its edges. In (0, 1]; 0 without edges.
 */
inline double commonShare(double own, double edges)
{
  return own > edges ? edges / own : 1.0;
}

} // namespace smg
