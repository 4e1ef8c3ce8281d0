// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * The factor of a row in the norm of the initial residual, by which all others are measured. Where
 * `own`, the contribution of screening, Robin and soft conditions to the diagonal, and what the
 * weights of slivers have beyond those of regular cells, is larger than the magnitudes of the
 * ordinary weights of the `edges`, the initial residual is as large as `own`, whatever that of all
 * other rows is; the row then counts as if it had only ordinary edges. In (0, 1]; 0 without edges.
 */
inline double commonShare(double own, double edges)
{
  return own > edges ? edges / own : 1.0;
}

} // namespace smg
