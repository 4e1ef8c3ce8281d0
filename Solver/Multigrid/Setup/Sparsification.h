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
 * Removes small entries of a coarse operator without changing its row sums: an edge (c,k) with
 * |w| < tolerance * min(strongest_c, strongest_k) moves its weight to the two edges (c,m) and (m,k)
 * of the strongest common neighbour m, both large, and if w is negative larger than 2 |w|; without
 * such an m it stays; with dropsNegative only if it is positive. No entry is removed of a row that
 * is stiff, whose weights cancel, or whose coupling (see Patches) to a row before or after it is
 * above Coupled: small entries decide its soft modes. Of a row m that comes later only what those
 * of c and k say counts, and of couplings those to rows that have come.
 */
struct SMG_EXPORT Sparsification
{
  /** 0 (nothing is removed) to 0.1; above 0.1 V-cycles diverge. */
  float tolerance = 0.1F;
  /** Whether negative weights without an m are removed. That makes the operator stiffer: a cluster
   * that small weights of either sign hold may be held several times as strongly. */
  bool dropsNegative = false;
  static constexpr double Coupled = 0.5;

  /** Processes the pairs (c,k), c < k, as soon as row k exists. */
  void operator()(CoarseningData& data, std::int64_t k) const;

private:
  struct Candidate;

  /** Whether a weight is, given the largest ones of its two rows. */
  bool isSmall(float weight, float strongest, float otherStrongest) const
  {
    return !(std::fabs(weight) >= this->tolerance * std::min(strongest, otherStrongest));
  }
  /** Whether the weight of a row's neighbour at distance delta is large, given the largest weight
   * of that row and of the rows before it; later neighbours do not count. */
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
