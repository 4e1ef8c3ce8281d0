// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseningData.h"

#include <vector>

namespace smg
{

/**
 * The coarse operator P^T A P, a row of A P at a time and then a row of the product at a time.
 * Row sums are accumulated by themselves in double precision, from differences of row sums of P, so
 * that a component without constraint has row sums of exactly zero on every level. A row copies its
 * lower part from the rows above it: the product is exactly symmetric.
 */
class GalerkinProduct
{
public:
  /** Appends row i of A P. The rows of P up to reach(i) are there. */
  void multiply(CoarseningData& data, std::int64_t i) const;

  /** Appends row c of P^T A P. All its children are known and their rows of A P are there. */
  void gather(CoarseningData& data, std::int64_t c);

private:
  void sort();

  std::vector<std::int32_t> Columns, Sorted;
};

} // namespace smg
