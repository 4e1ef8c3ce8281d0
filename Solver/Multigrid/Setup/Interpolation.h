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
 * Extended interpolation: the interpolation of the paper, equation (5), relaxed like the unknowns.
 * A C-point takes the value of its coarse node. For an F-point j
 *
 *   P0_jk = w_jk / Z_j,  Z_j = alpha_j + sum of the w_jk,   k the strong C-neighbours,
 *
 * where alpha_j is the row sum of A, 0 if that is negative. Then one or several sweeps over the
 * rows, in stream order and in place, solve row j for P_j
 *
 *   A_jj P_j = sum over all neighbours m of w_jm P_m,
 *
 * so that coarse nodes at a distance of two edges contribute, and together with the response of
 * F-neighbours m with w_jm > 0 to P_j ("extended+i": De Sterck, Falgout, Nolting, Yang,
 * Distance-two interpolation for parallel algebraic multigrid, 2008):
 *
 *   P_m = (Z_m P0_m + w_jm P_j) / (Z_m + w_jm)  before m is relaxed,
 *   P_m + w_jm / A_mm (P_j - the P_j before)    afterwards.
 *
 * Without it two F-points that are close to each other hold each other in place. The rows of lower
 * neighbours are already those of this sweep. The F-points of a patch b (see Patches) are relaxed
 * together, at the last of them: P_b = A_bb^-1 sum over m not in b of w_bm P_m.
 *
 * A row has only columns that occur in P0 of a neighbour, and of these the `entries` with the
 * largest magnitudes. The others are distributed to them in proportion to their magnitudes, so the
 * row keeps its sum. Next to a stiff row (see SliverRows), where an error of P costs most, a row
 * has RelaxedRow::Most entries: a chain of slivers that loses one end moves with the other. Entries
 * may be negative, which smooth functions across a sliver require. Rows that cancel are then fitted
 * to linear functions (LinearRows). Finally weights are rounded to multiples of 1/Quanta, and the
 * largest entry takes the remainder.
 *
 * A row depends on rows within one ring, in stream order, and a sweep is a stage behind the stage
 * of P0: every sweep adds a ring to the window, and 40 bytes per node (RelaxedRow) stay in memory
 * until the rows that contain the node are final.
 */
class SMG_EXPORT ExtendedInterpolation
{
public:
  IndependentSetCoarsening coarsePoints;
  /** The most entries of a row of the finest level that does not cancel (see
   * IndependentSetCoarsening), and of all other rows, 2 to RelaxedRow::Most. */
  int finestEntries = 3;
  int entries = 4;
  /** Number of sweeps, at least 1. */
  int sweeps = 1;
  /** Whether rows that cancel are fitted to linear functions (LinearRows), where nodes have
   * positions. */
  bool linear = true;

  /** Appends row i of P0. The C-points among the nodes up to reach(i) must have been chosen. */
  void initial(CoarseningData& data, std::int64_t i) const;

  /** Relaxes row i in a sweep. */
  void relax(CoarseningData& data, std::int64_t i);

private:
  /** A column and its weight; the coarse node is given by its distance from publishedCoarse. */
  struct Candidate
  {
    std::int32_t distance;
    float weight;
  };
  using Candidates = std::vector<Candidate>;

  /** What the neighbours outside a patch contribute to the equation of one of its nodes: the
   * weighted sum of their rows, and by how much these fall short of a sum of 1. */
  struct Outside
  {
    Candidates weights;
    double lacking;
    float ofItself; ///< weight of the node itself in their rows
  };

  void relaxNode(CoarseningData& data, std::int64_t i);
  void relaxPatch(CoarseningData& data, const Patch& patch, const int* members, int count);
  static void gatherOutside(
    CoarseningData& data, std::int64_t i, const Patch& patch, std::uint32_t inside, Outside& sum);
  void openPattern(const CoarseningData& data, std::int64_t i, std::uint32_t mark);
  void closePattern(const CoarseningData& data, float factor);
  int entriesOf(const CoarseningData& data, std::int64_t i) const;
  void store(CoarseningData& data, std::int64_t i, double sum);

  Candidates Row; ///< the row that is being relaxed
  /** Of the members of the patch that is being relaxed. */
  std::array<Outside, PatchMatrix::Most> Of;
};

} // namespace smg
