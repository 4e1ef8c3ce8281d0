// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"

#include <cstdint>
#include <type_traits>

namespace smg
{

/** b_k - A_kk x_k + sum_j w_kj x_j of node k of a block. Sums even and odd entries separately,
 * as GaussSeidel does. */
struct PlainResidual
{
  template <class Vectors, class Real, class Arrays>
  [[gnu::always_inline]] static typename Vectors::Vector of(const RowBlock::Header& h,
    const Arrays& a, std::int64_t k, std::int64_t stride, const Real* x, const Real* b)
  {
    const BlockRange row = entriesOf(h, a, k);
    const Real* xk = x + k * stride;
    auto even =
      Vectors::load(b + k * stride) - static_cast<Real>(a.diagonal[k]) * Vectors::load(xk);
    typename Vectors::Vector odd{};
    std::int64_t e = row.begin;
    for (; e + 1 < row.end; e += 2)
    {
      even += static_cast<Real>(a.weight[e]) * Vectors::load(xk + a.delta[e] * stride);
      odd += static_cast<Real>(a.weight[e + 1]) * Vectors::load(xk + a.delta[e + 1] * stride);
    }
    if (e < row.end)
    {
      even += static_cast<Real>(a.weight[e]) * Vectors::load(xk + a.delta[e] * stride);
    }
    return even + odd;
  }
};

/**
 * The same residual in the form b_k - alpha_k x_k + sum_j w_kj (x_j - x_k), alpha_k the row sum.
 * The large weights of slivers then multiply small differences, which reduces the rounding, and the
 * sum over a patch does not lose the row sum, which may be smaller than the rounding of the
 * diagonal. Edges to prescribed nodes are part of the row sum and of b, and are rounded like these.
 */
struct ResidualOfDifferences
{
  template <class Vectors, class Real, class Arrays>
  [[gnu::always_inline]] static typename Vectors::Vector of(const RowBlock::Header& h,
    const Arrays& a, std::int64_t k, std::int64_t stride, const Real* x, const Real* b)
  {
    const BlockRange row = entriesOf(h, a, k);
    const auto xk = Vectors::load(x + k * stride);
    auto sum = Vectors::load(b + k * stride) - static_cast<Real>(RowBlock::rowSumOf(h, a, k)) * xk;
    for (std::int64_t e = row.begin; e < row.end; ++e)
    {
      sum += static_cast<Real>(a.weight[e]) * (Vectors::load(x + (k + a.delta[e]) * stride) - xk);
    }
    return sum;
  }
};

/** Calls f(residual, rows, nodes) for runs of nodes of a part, with the residual that is theirs and
 * the arrays of their rows: on the finest level special nodes get the residual by differences, all
 * others the plain one, or the same if `differs`. */
template <class Real, class Arrays, class F>
[[gnu::always_inline]] inline void forResiduals(
  const Arrays& a, const BlockPart<Real>& part, const F& f, bool differs = false)
{
  if constexpr (std::is_same_v<Real, double>)
  {
    for (NodeRuns runs(part.header(), a, part.nodes); runs.next();)
    {
      if (!runs.special())
      {
        differs ? f(ResidualOfDifferences(), a, runs.nodes()) : f(PlainResidual(), a, runs.nodes());
        continue;
      }
      visitSpecial<Real>(part.header(), a, *runs.special(),
        [&](const auto& row) { f(ResidualOfDifferences(), row, runs.nodes()); });
    }
  }
  else
  {
    f(PlainResidual(), a, part.nodes);
  }
}

/** Stores the residual of each node, with the stride of the level: a kernel for
 * LevelWindow::forColumns(). */
template <class Real>
struct StoreResidual
{
  Real* residual; ///< of node 0 of the level; may be b

  template <class Arrays, class Vectors>
  void operator()(const Arrays& a, Vectors, const BlockPart<Real>& part) const
  {
    const std::int64_t stride = Vectors::count == 1 ? 1 : part.stride;
    forResiduals(a, part,
      [&](auto kind, const auto& rows, BlockRange nodes)
      {
        for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
        {
          Vectors::store(this->residual + (part.header().first + k) * stride + part.lane,
            decltype(kind)::template of<Vectors>(part.header(), rows, k, stride, part.x, part.b));
        }
      });
  }
};

} // namespace smg
