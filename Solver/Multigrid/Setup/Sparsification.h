// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/Export.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace smg
{

/**
 * Removes small entries of a coarse operator and keeps its row sums. The edge (c, k) with |w| <
 * tolerance * min(strongest_c, strongest_k) is removed, and its weight is added to the two edges
 * (c, m) and (m, k) of the strongest common neighbour m; both of these must be large, and larger
 * than 2 |w| if w is negative. Without such an m the edge stays; with dropsNegative it stays only
 * if w is positive.
 *
 * No entry is removed from a row that is stiff, whose weights cancel, or whose coupling (see
 * Patches) to another row is above Coupled: there, small entries decide the soft modes.
 *
 * Edges are decided when the later row k arrives. Of a row m after k only the entries of rows c and
 * k are known, and of couplings only those to rows that have arrived: a rule that depends on the
 * stream order, but not on the window.
 */
struct SMG_EXPORT Sparsification
{
  /** From 0 (nothing is removed) to 0.1; above 0.1 V-cycles diverge. */
  float tolerance = 0.1F;
  /** Whether negative weights without a common neighbour m are removed. That makes the operator
   * stiffer: what held a cluster of vertices was the small sum of weights of either sign, and
   * without the negative ones it may be several times as large. */
  bool dropsNegative = false;
  static constexpr double Coupled = 0.5;

  /** Decides the pairs (c, k), c < k, when row k arrives. */
  void operator()(CoarseningData& data, std::int64_t k) const;

private:
  struct Candidate;

  /** Whether a weight is small, given the largest weights of its two rows. Written so that a
   * NaN, the weight of a removed entry, is small. */
  bool isSmall(float weight, float strongest, float otherStrongest) const
  {
    return !(std::fabs(weight) >= this->tolerance * std::min(strongest, otherStrongest));
  }
  /** Whether the weight of the neighbour at distance `delta` is large, given a pointer to the
   * largest weight of the row; those of earlier rows precede it. The largest weights of later
   * neighbours are not known: for these the row alone decides. */
  bool isLarge(float weight, std::int32_t delta, const StrongestWeight* strongest) const
  {
    const StrongestWeight other = strongest[std::min(delta, 0)];
    return !this->isSmall(weight, strongest->weight(), other.weight());
  }
  void keepStronglyCoupled(const CoarseningData& data, std::int64_t k) const;
  Candidate strongestCommon(
    const CoarseningData& data, std::int64_t c, std::uint32_t mark, float least) const;
};

} // namespace smg
