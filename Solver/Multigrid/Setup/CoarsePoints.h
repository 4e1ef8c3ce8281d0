// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <algorithm>
#include <cfloat>
#include <cstdint>

namespace smg
{

/**
 * The choice of C-points of the paper on strong edges: a greedy maximal independent set in stream
 * order. Node i is a C-point iff none of the lower nodes that it strongly depends on is, or if its
 * row is stiff or exceeds. A node without edges is never a C-point: relaxation solves it exactly.
 */
struct IndependentSetCoarsening
{
  /** An edge of row i is strong when w_ij >= strength * max_k w_ik; in [0, 1). */
  float strength = 0.1F;
  /** The same where row i belongs to slivers. In a lattice of obtuse triangles the strongest
   * couplings form lines; a smaller strength leaves whole lines without a coarse node. */
  float sliverStrength = 0.1F;
  /** A row belongs to slivers if the sum of the magnitudes of its weights exceeds this multiple of
   * its diagonal; at least 1. */
  float cancelling = 1.2F;

  bool isOfSlivers(const CoarseningData& data, std::int64_t i) const
  {
    return data.fine.magnitudes(i) > this->cancelling * data.patches.diagonal(i);
  }

  float threshold(const CoarseningData& data, std::int64_t i) const
  {
    const bool isAlike = this->strength == this->sliverStrength;
    const float share =
      !isAlike && this->isOfSlivers(data, i) ? this->sliverStrength : this->strength;
    return std::max(share * data.fine.strongest(i), FLT_MIN);
  }

  /** Whether node i moves so much more than its neighbours that entries of P up to 1 cannot
   * represent it: next to constrained nodes with negative weights. */
  static bool exceeds(const CoarseningData& data, std::int64_t i)
  {
    return data.fine.rowSum(i) < -0.5 * static_cast<double>(data.patches.diagonal(i));
  }

  /** Whether node i is a C-point; the nodes below i are decided. */
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
