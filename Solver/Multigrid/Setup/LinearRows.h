// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/Export.h"

#include <cstdint>

namespace smg
{

/**
 * Rows of P that reproduce linear functions. In a lattice of obtuse triangles, or of flat
 * tetrahedra, the stiff part of the energy vanishes only for functions that are linear along the
 * long direction. Rows that lost this with the entries that were dropped make the coarse operator
 * too stiff by a factor at each level.
 *
 * Of row i, with the entries p_c and the sum 1, as little as possible is changed so that the
 * positions of the C-points reproduce that of the node, as far as bounded entries can:
 *
 *   minimise  sum (q_c - p_c)^2 / (|p_c| + Slack) + |sum q_c x_c - x_i|^2 / (l d)^2,  sum q_c = 1,
 *
 * d the distance of the farthest C-point, for l = Exact, then Loose, until all q_c lie within the
 * bounds; else the row stays as it is. With b_c = (x_c - x_i) / d, D = diag(|p_c| + Slack) and B
 * the b_c less their D-weighted mean, q = p + D B y, where (B^T D B + l^2) y = -sum p_c b_c: three
 * equations, whatever the number of entries.
 *
 * Only rows whose weights cancel need it: elsewhere it changes good rows for worse. A position
 * takes 12 bytes per node, from the row of the node on until the rows of P and of the coarse node
 * exist; no stage waits for more. Scaling or moving the mesh changes nothing but rounding.
 */
struct LinearRows
{
  /** Rows are fitted whose weights have magnitudes that sum to more than this multiple of the
   * diagonal. */
  static constexpr float Cancelling = 1.2F;
  static constexpr double Exact = 0.1, Loose = 0.3;
  static constexpr double Slack = 0.05;
  static constexpr double Least = -0.5, Most = 1.5;

  static bool isFitted(const CoarseningData& data, std::int64_t i)
  {
    return data.fine.magnitudes(i) > Cancelling * data.patches.diagonal(i);
  }
  /** Fits row i, which has been truncated. The nodes have positions. */
  SMG_EXPORT static void fit(const CoarseningData& data, std::int64_t i, RelaxedRow& row);
};

} // namespace smg
