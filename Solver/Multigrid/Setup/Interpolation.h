// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarsePoints.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/Export.h"

#include <array>
#include <vector>

namespace smg
{

/**
 * Extended interpolation: that of the paper, relaxed like the unknowns. A C-point takes the
 * value of its coarse node. For an F-point j
 *
 *   P0_jk = w_jk / Z_j,  Z_j = alpha_j + sum of the w_jk,   k the strong C-neighbours.
 *
 * Then one or several sweeps over the rows, in stream order and in place, solve row j for P_j
 *
 *   A_jj P_j = sum over all neighbours m of w_jm P_m,
 *
 * together with what F-neighbours with w_jm > 0 take from it ("extended+i": De Sterck,
 * Falgout, Nolting, Yang, Distance-two interpolation for parallel algebraic multigrid, 2008):
 *
 *   P_m = (Z_m P0_m + w_jm P_j) / (Z_m + w_jm)  before m is relaxed,
 *   P_m + w_jm / A_mm (P_j - the P_j before)    afterwards,
 *
 * where the rows of lower neighbours are those of this sweep; the F-points of a patch b (see
 * Patches) are relaxed together, at its last one: P_b = A_bb^-1 sum over m not in b of w_bm P_m. A
 * row has only columns that occur in P0 of a neighbour, and of these the `entries` with the largest
 * magnitudes. The others are distributed to them in proportion to their magnitudes, so the row
 * keeps its sum. Next to a stiff row (see SliverRows), where an error of P costs most, it has
 * RelaxedRow::Most of them: a chain of slivers that loses one end moves with the other. Entries may
 * be negative, which smooth functions across a sliver require.
 *
 * Finally weights are rounded to multiples of 1/Quanta, and the largest one takes the remainder.
 */
class SMG_EXPORT ExtendedInterpolation
{
public:
  IndependentSetCoarsening coarsePoints;
  /** Entries of a row of the finest level that does not belong to slivers (see
   * IndependentSetCoarsening), and of all others, 2 to RelaxedRow::Most. */
  int finestEntries = 4;
  int entries = 4;
  /** Sweeps, at least 1. */
  int sweeps = 2;

  /** Appends row i of P0. The C-points are chosen among the nodes up to reach(i). */
  void initial(CoarseningData& data, std::int64_t i) const;

  /** Relaxes row i in a sweep. */
  void relax(CoarseningData& data, std::int64_t i);

  /** Appends row i of P, which has been relaxed. */
  void append(CoarseningData& data, std::int64_t i) const;

private:
  /** A weight for a coarse node, at a distance from seenCoarse. */
  struct Candidate
  {
    std::int32_t distance;
    float weight;
  };
  using Candidates = std::vector<Candidate>;

  /** The contribution of the neighbours outside a patch to one of its nodes: the sum of their rows,
   * and the deficits of their row sums. */
  struct Outside
  {
    Candidates weights;
    double lacking;
    float ofItself; ///< what the neighbours take from it
  };

  void relaxNode(CoarseningData& data, std::int64_t i);
  void relaxPatch(CoarseningData& data, const Patch& patch, const int* members, int count);
  static void gatherOutside(
    CoarseningData& data, std::int64_t i, const Patch& patch, std::uint32_t inside, Outside& sum);
  void openPattern(const CoarseningData& data, std::int64_t i, std::uint32_t mark);
  void closePattern(const CoarseningData& data, float factor);
  int entriesOf(const CoarseningData& data, std::int64_t i) const;
  void store(CoarseningData& data, std::int64_t i, double sum);

  Candidates Row; ///< the relaxed row
  std::array<Outside, PatchMatrix::Most> Of;
};

} // namespace smg
