// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Lanes.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"

#include <cstdint>

namespace smg
{

/** The nodes [begin, end) of a block, by their indices in the block. */
struct BlockRange
{
  std::int64_t begin, end;
};

/** The entries of row k of a block. */
template <class Arrays>
inline BlockRange entriesOf(const RowBlock::Header& h, const Arrays& a, std::int64_t k)
{
  const std::int32_t start = h.entryStart[static_cast<std::size_t>(k / RowBlock::Group)];
  return { start + (k % RowBlock::Group ? a.entryEnd[k - 1] : 0), start + a.entryEnd[k] };
}

/** The parents of row k of a block. */
template <class Arrays>
inline BlockRange parentsOf(const RowBlock::Header& h, const Arrays& a, std::int64_t k)
{
  const std::int32_t start = h.parentStart[static_cast<std::size_t>(k / RowBlock::Group)];
  return { start + (k % RowBlock::Group ? a.parentEnd[k - 1] : 0), start + a.parentEnd[k] };
}

/** Forward Gauss-Seidel in stream order: x_i = (b_i + sum_j w_ij x_j) / A_ii. x and b point to node
 * 0 of the block, with `stride` values per node. */
struct GaussSeidel
{
  /** LowerOnly: the nodes above are zero (first sweep on a coarse level) and are not read. */
  template <bool LowerOnly, class Vectors, class Real, class Arrays>
  static void sweep(const RowBlock::Header& h, const Arrays& a, BlockRange nodes,
    std::int64_t stride, Real* x, const Real* b)
  {
    for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
    {
      const BlockRange row = entriesOf(h, a, k);
      Real* xk = x + k * stride;
      auto even = Vectors::load(b + k * stride);
      typename Vectors::Vector odd{};
      std::int64_t e = row.begin;
      if constexpr (LowerOnly)
      {
        for (; e < row.end && a.delta[e] < 0; ++e)
        {
          even += static_cast<Real>(a.weight[e]) * Vectors::load(xk + a.delta[e] * stride);
        }
      }
      else
      {
        for (; e + 1 < row.end; e += 2)
        {
          even += static_cast<Real>(a.weight[e]) * Vectors::load(xk + a.delta[e] * stride);
          odd += static_cast<Real>(a.weight[e + 1]) * Vectors::load(xk + a.delta[e + 1] * stride);
        }
        if (e < row.end)
        {
          even += static_cast<Real>(a.weight[e]) * Vectors::load(xk + a.delta[e] * stride);
        }
      }
      Vectors::store(xk, (even + odd) * static_cast<Real>(1.0 / a.diagonal[k]));
    }
  }
};

} // namespace smg
