// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseningData.h"
#include "Solver/Hierarchy/Lifting.h"
#include "smg/Export.h"

#include <array>
#include <vector>

namespace smg
{

/**
 * Extended interpolation: that of the paper, relaxed as the unknowns are. A lifted node takes the
 * value of its coarse node. For a retained node j
 *
 *   P0_jk = w_jk / Z_j,  Z_j = alpha_j + sum of the w_jk,   k the strong lifted neighbours.
 *
 * Then a sweep over the rows in stream order and in place, or several, replaces the row by
 *
 *   P_j = sum over all neighbours m of w_jm P_m, divided by A_jj,
 *
 * where the rows of lower neighbours are those of this sweep; the retained nodes of a patch b (see
 * Patches) are done together, at its last one: P_b = A_bb^-1 sum over m not in b of w_bm P_m. Of a
 * row only columns count that occur in P0 of a neighbour, and of these the `entries` with the
 * largest magnitudes. They take over what the others had in proportion to their magnitudes, so the
 * row keeps its sum, and may be negative: a smooth function across a sliver needs that.
 *
 * At last weights are rounded to multiples of 1/Quanta, and the largest one takes the rest.
 */
class SMG_EXPORT ExtendedInterpolation
{
public:
  IndependentSetLifting lifting;
  /** Entries kept of a row of the finest level that is not one of slivers, and of all others, 2 to
   * RelaxedRow::Most. */
  int finestEntries = 4;
  int entries = 4;
  /** A row is one of slivers if the magnitudes of its weights sum up to more than this many times
   * its diagonal; at least 1. */
  float cancelling = 1.2F;
  /** Sweeps, at least 1. */
  int sweeps = 2;

  /** Appends row i of P0. The nodes up to reach(i) have been decided. */
  void initial(CoarseningData& data, std::int64_t i) const;

  /** Node i's turn in a sweep. */
  void relax(CoarseningData& data, std::int64_t i);

  /** Appends row i of P, which has been relaxed. */
  void append(CoarseningData& data, std::int64_t i) const;

private:
  /** A weight for a coarse node, at a distance from coarseNodes. */
  struct Candidate
  {
    std::int32_t distance;
    float weight;
  };
  using Candidates = std::vector<Candidate>;

  /** What the neighbours outside of a patch say of one of its nodes: the sum of their rows, and
   * what their row sums lack. */
  struct Outside
  {
    Candidates weights;
    double lacking;
  };

  void relaxNode(CoarseningData& data, std::int64_t i);
  void relaxPatch(CoarseningData& data, const Patch& patch, const int* members, int count);
  void gather(const CoarseningData& data, std::int64_t i);
  static void gatherOutside(
    CoarseningData& data, std::int64_t i, const Patch& patch, std::uint8_t inside, Outside& sum);
  void openPattern(const CoarseningData& data, std::int64_t i, std::uint32_t mark);
  void closePattern(const CoarseningData& data);
  int entriesOf(const CoarseningData& data, std::int64_t i) const;
  void store(CoarseningData& data, std::int64_t i, double sum);

  Candidates Row; ///< the row that is relaxed
  std::array<Outside, PatchMatrix::Most> Of;
};

} // namespace smg
