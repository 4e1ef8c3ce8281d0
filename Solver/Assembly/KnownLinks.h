// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"

#include <cstdint>
#include <span>

namespace smg
{

/** An edge from an unknown of a block of the finest level to a vertex with a known value: rows have
 * its weight in their row sum, but no entry. */
struct KnownLink
{
  std::int32_t node;  ///< counted from the first node of the block
  std::int32_t delta; ///< the neighbour minus the node
  double weight;
};

/** Adds w_ij x_j for the links of a block to b_i. `first` is the first node of the block. */
inline void addKnownValues(std::int64_t first, std::span<const KnownLink> links, int columns,
  const Ring<double>& x, const Ring<double>& b)
{
  for (const KnownLink& link : links)
  {
    const std::int64_t i = first + link.node;
    for (int k = 0; k < columns; ++k)
    {
      b.at(i)[k] += link.weight * x.at(i + link.delta)[k];
    }
  }
}

} // namespace smg
