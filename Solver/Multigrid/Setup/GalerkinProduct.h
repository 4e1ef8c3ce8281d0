// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * The coarse operator P^T A P: a row of A P at a time, and then a row of the product at a time.
 *
 * Two properties are exact, whatever the rounding of the entries. Row sums: they are not summed
 * from the entries but computed by themselves, in double precision (the row sums of A P are stored
 * in single precision), from differences of the row sums of P; a component without a constraint
 * therefore has row sums of exactly zero on every level. Symmetry: of the two weights of a pair the
 * one in the upper of its rows counts (see finishRow()).
 */
class SMG_EXPORT GalerkinProduct
{
public:
  /** As IndependentSetCoarsening::cancelling, of coarse rows. No entry is removed from a row that
   * cancels: its small entries determine its soft modes. */
  double cancelling = 1.5;

  /** Appends row i of A P. The rows of P up to reach(i) must exist. */
  void productAP(CoarseningData& data, std::int64_t i);

  /** Appends row c of P^T A P to `gathered`, as weights (minus its entries). All children of c and
   * their rows of A P must exist. */
  void productPtAP(CoarseningData& data, std::int64_t c);

private:
  /** A child i of coarse node c: its row of A P, and P_ic. */
  struct Child
  {
    const CoarseEntry* product;
    std::int64_t size;
    float weight;
  };

  /** Finds the children of node c, prefetches their rows of A P, and returns the row sum of row
   * c. */
  double findChildren(const CoarseningData& data, std::int64_t c);
  /** Sorts the first `size` of Columns into Sorted. */
  void sort(std::size_t size);

  /** Appends row c with the columns in Sorted and this row sum. */
  void append(CoarseningData& data, std::int64_t c, double rowSum);

  // Used by productAP(), which may run on another thread than productPtAP().
  std::vector<std::int32_t> RowColumns;

  // Used by productPtAP(). On a cache line of their own, so that the two threads do not share one.
  alignas(64) std::vector<Child> Children;
  std::vector<std::int32_t> Columns, Sorted;
};

} // namespace smg
