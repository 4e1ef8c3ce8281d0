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
 * The coarse operator P^T A P, a row of A P at a time and then a row of the product at a time.
 * Row sums are accumulated by themselves in double precision, one for a row of A P in single
 * precision, from differences of row sums of P, so that a component without constraint has row sums
 * of exactly zero on every level. Of the two weights of a pair the one in the upper of its rows
 * counts: so the product is exactly symmetric.
 */
class SMG_EXPORT GalerkinProduct
{
public:
  /** No entry is removed from a row whose magnitudes of weights sum to more than this multiple of
   * its diagonal, above 1: its small entries determine its soft modes. */
  double cancelling = 1.5;

  /** Appends row i of A P. The rows of P up to reach(i) must exist. */
  void productAP(CoarseningData& data, std::int64_t i);

  /** Appends row c of P^T A P to `gathered`. All its children and their rows of A P must exist. */
  void productPtAP(CoarseningData& data, std::int64_t c);

private:
  /** A child of the node of the gathered row, and its row of A P. */
  struct Child
  {
    const CoarseEntry* product;
    std::int64_t size;
    float weight;
  };

  /** Finds the children of node c, prefetches their rows of A P, and returns the row sum of the
   * node. */
  double findChildren(const CoarseningData& data, std::int64_t c);
  /** Sorts the first `size` of Columns. */
  void sort(std::size_t size);

  /** Appends the row of node c, with the columns of Sorted and this row sum. */
  void append(CoarseningData& data, std::int64_t c, double rowSum);

  // Of productAP(), which may run on another thread than productPtAP().
  std::vector<std::int32_t> RowColumns;

  // Of productPtAP(), on another cache line.
  alignas(64) std::vector<Child> Children;
  std::vector<std::int32_t> Columns, Sorted;
};

} // namespace smg
