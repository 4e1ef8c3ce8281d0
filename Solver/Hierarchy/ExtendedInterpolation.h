// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseningData.h"
#include "Solver/Hierarchy/Lifting.h"

#include <span>
#include <vector>

namespace smg
{

/**
 * Extended interpolation: one Jacobi step, over the retained neighbours, of the paper's
 * interpolation. A lifted node takes the value of its coarse node. For a retained node j
 *
 *   P0_jk = w_jk / Z_j,  Z_j = alpha_j + sum of the w_jk,   k the strong lifted neighbours,
 *   P_j   = sum over all neighbours m of w_jm P0_m, divided by A_jj,
 *
 * of which the largest `entries` are kept, scaled to the old sum and rounded to multiples of
 * 1/Quanta with that sum kept.
 */
class ExtendedInterpolation
{
public:
  IndependentSetLifting lifting;
  /** Entries kept of a row of the finest level and of the others, from 2 to ChildLink::Slots. */
  int finestEntries = 4;
  int entries = 4;

  /** Appends row i of P0. The nodes up to reach(i) have been decided. */
  void initial(CoarseningData& data, std::int64_t i) const;

  /** Appends row i of P. The rows of P0 up to reach(i) are there. */
  void operator()(CoarseningData& data, std::int64_t i);

private:
  struct Candidate
  {
    std::int32_t distance; ///< of the coarse node from coarseNodes
    float weight;
  };

  void gather(CoarseningData& data, std::int64_t i);
  void truncate(int entries);
  void append(CoarseningData& data, std::int64_t i);

  std::vector<Candidate> Candidates;
  std::vector<std::uint32_t> Rounded;
};

} // namespace smg
