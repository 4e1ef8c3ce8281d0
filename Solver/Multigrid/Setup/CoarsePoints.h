// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <algorithm>
#include <cfloat>
#include <cstdint>

namespace smg
{

/**
 * The choice of C-points of the paper (Shi, Bao, Zhou 2009, section 2.1: nodes that are "lifted"),
 * on strong edges only: a greedy maximal independent set in stream order. Node i is a C-point if
 * none of the lower nodes that it depends on strongly is one, or if its row is stiff or exceeds().
 * A node without edges is never a C-point: relaxation solves its equation exactly.
 *
 * The decision needs the row of i and the decisions on its lower neighbours only, so one sweep over
 * the stream makes it, whatever the window.
 */
struct IndependentSetCoarsening
{
  /** Edge (i, j) is strong for row i if w_ij >= strength * max_k w_ik; in [0, 1). */
  float strength = 0.2F;
  /** The same for rows that cancel. In a lattice of obtuse triangles the strongest couplings form
   * lines; a smaller strength leaves whole lines without a C-point. */
  float cancellingStrength = 0.6F;
  /** A row cancels if the magnitudes of its weights sum to more than this multiple of its
   * diagonal; at least 1. If no weight is negative, the sum is at most the diagonal. */
  float cancelling = 1.2F;

  bool cancels(const CoarseningData& data, std::int64_t i) const
  {
    return data.fine.magnitudes(i) > this->cancelling * data.patches.diagonal(i);
  }

  /** The least weight of a strong edge of row i. At least FLT_MIN, so that zero and negative
   * weights are never strong, even where the largest weight of the row is 0. */
  float threshold(const CoarseningData& data, std::int64_t i) const
  {
    const bool isAlike = this->strength == this->cancellingStrength;
    const float share =
      !isAlike && this->cancels(data, i) ? this->cancellingStrength : this->strength;
    return std::max(share * data.fine.strongest(i), FLT_MIN);
  }

  /** Whether the weights of row i sum to more than 1.5 times its diagonal, as they do next to
   * prescribed nodes with negative weights. Such a node moves more than its neighbours do,
   * which entries of P up to 1 cannot represent: it becomes a C-point. */
  static bool exceeds(const CoarseningData& data, std::int64_t i)
  {
    return data.fine.rowSum(i) < -0.5 * static_cast<double>(data.patches.diagonal(i));
  }

  /** Whether node i is a C-point, given the decisions on the nodes below it. */
  bool operator()(const CoarseningData& data, std::int64_t i) const
  {
    const auto row = data.fine.row(i);
    if (data.fine.stiff(i) || (!row.empty() && this->exceeds(data, i)))
    {
      return true;
    }
    const float strong = this->threshold(data, i);
    const CoarseIndex* coarseIndex = data.coarseIndex.at(i);
    for (const RowEntry& entry : row)
    {
      // Entries are sorted by column: from here on the neighbours are undecided.
      if (entry.delta() > 0)
      {
        break;
      }
      if (entry.weight() >= strong && coarseIndex[entry.delta()] != CoarseningData::FPoint)
      {
        return false;
      }
    }
    return !row.empty();
  }
};

} // namespace smg
