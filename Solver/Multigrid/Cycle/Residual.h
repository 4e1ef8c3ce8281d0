// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"

#include <cstdint>
#include <type_traits>

namespace smg
{

/** b_k - A_kk x_k + sum_j w_kj x_j of node k of a block. */
struct PlainResidual
{
  template <class Vectors, class Real, class Arrays>
  static typename Vectors::Vector of(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
    std::int64_t stride, const Real* x, const Real* b)
  {
    const RowView row(h, a, k);
    const Real* xk = x + k * stride;
    return row.template plusProducts<Vectors>(
      Vectors::load(b + k * stride) - static_cast<Real>(row.diagonal) * Vectors::load(xk), xk,
      stride);
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
  static typename Vectors::Vector of(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
    std::int64_t stride, const Real* x, const Real* b)
  {
    const RowView row(h, a, k);
    const auto xk = Vectors::load(x + k * stride);
    auto sum = Vectors::load(b + k * stride) - static_cast<Real>(RowBlock::rowSumOf(h, a, k)) * xk;
    for (std::int64_t e = 0; e < row.size(); ++e)
    {
      sum +=
        static_cast<Real>(row.weight(e)) * (Vectors::load(x + (k + row.delta(e)) * stride) - xk);
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
    forRuns<Real>(part.header(), a, part.nodes,
      [&](const auto& rows, BlockRange nodes, auto isSpecial)
      {
        if constexpr (!isSpecial)
        {
          if (!differs)
          {
            f(PlainResidual(), rows, nodes);
            return;
          }
        }
        f(ResidualOfDifferences(), rows, nodes);
      });
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
