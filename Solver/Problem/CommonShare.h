// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * Where `own`, what screening, Robin and soft conditions bring to the diagonal of a row, outweighs
 * the magnitudes of the weights of its `edges`, the row determines its unknown by itself, at once,
 * and its residual begins as large as `own` is: in the measure that all other rows are to meet it
 * counts as if it had only the weight of its edges. In (0, 1]; 0 without edges.
 */
inline double commonShare(double own, double edges)
{
  return own > edges ? edges / own : 1.0;
}

} // namespace smg
