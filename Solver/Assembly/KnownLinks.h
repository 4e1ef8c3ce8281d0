// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** An edge from an unknown of a block of the finest level to a vertex with a known value: rows have
 * its weight in their row sum, but no entry. */
template <class Weight>
struct KnownLink
{
  std::int32_t node;  ///< counted from the first node of the block
  std::int32_t delta; ///< the neighbour minus the node
  Weight weight;
};

/** Adds w_ij x_j for the links of a block, by ascending node, to b_i; calls done(i) after the last
 * one of a node. `first` is the first node of the block. */
template <class Link, class Done>
void addKnownValues(std::int64_t first, std::span<const Link> links, int columns,
  const Ring<double>& x, const Ring<double>& b, Done&& done)
{
  for (std::size_t l = 0; l < links.size();)
  {
    const std::int32_t node = links[l].node;
    const std::int64_t i = first + node;
    for (; l < links.size() && links[l].node == node; ++l)
    {
      for (int k = 0; k < columns; ++k)
      {
        b.at(i)[k] += static_cast<double>(links[l].weight) * x.at(i + links[l].delta)[k];
      }
    }
    done(i);
  }
}

} // namespace smg
