// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Cycle/IterateFlow.h"
#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Cycle/Residual.h"
#include "Solver/Multigrid/Cycle/RowShare.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <cmath>
#include <cstdint>
#include <type_traits>

// The transfer between a level and the next coarser one, by the rows of P that blocks contain:
// kernels for LevelWindow::forColumns(), which the stages of a pass (LevelStages.cpp) and the
// levels in memory (VCycle.h) apply. Parents of a block are relative to one of them, parentBase. A
// ring is contiguous around any item in memory, so a pointer to that one reaches all of them.

namespace smg
{

/** Prolongation: x += scale P x_coarse. */
template <class Real>
struct Prolongation
{
  const Ring<float>& coarse;
  Real scale;

  template <class Arrays, class Vectors>
  void operator()(const Arrays& a, Vectors, const BlockPart<Real>& part) const
  {
    using CoarseVectors = SimdPack<float, Vectors::count>;
    const std::int64_t stride = Vectors::count == 1 ? 1 : part.stride;
    const float* coarseX = this->coarse.at(part.header().parentBase) + part.lane;
    for (std::int64_t k = part.nodes.begin; k < part.nodes.end; ++k)
    {
      const BlockRange row = parentsOf(part.header(), a, k);
      auto sum = Vectors::load(part.x + k * stride);
      for (std::int64_t e = row.begin; e < row.end; ++e)
      {
        const auto value = CoarseVectors::load(coarseX + a.parent[e] * stride);
        const float weight = static_cast<float>(a.parentQuanta[e]) * Quantum;
        // On the finest level the product is formed in double precision: the coarse correction is a
        // float, the sum is not.
        sum += (static_cast<Real>(weight) * this->scale) *
               __builtin_convertvector(value, typename Vectors::Vector);
      }
      Vectors::store(part.x + k * stride, sum);
    }
  }
};

/** residualShare() of row k of a block on the finest level. */
template <class Arrays>
double residualShareOf(const RowBlock::Header& h, const Arrays& a, std::int64_t k)
{
  const double own = RowBlock::rowSumOf(h, a, k);
  // Nearly all rows return here: the rest of the diagonal is the sum of their weights, of which
  // the magnitudes sum to at least as much.
  if (own == 0.0 || residualShare(commonShare(own, a.diagonal[k] - own)) == 1.0)
  {
    return 1.0;
  }
  const BlockRange row = entriesOf(h, a, k);
  double edges = 0.0;
  for (std::int64_t e = row.begin; e < row.end; ++e)
  {
    edges += std::fabs(static_cast<double>(a.weight[e]));
  }
  return residualShare(commonShare(own, edges));
}

/**
 * Residual and restriction: r = b - A x, and b_coarse += scale P^T r.
 *
 * Adds the squares of r to `squares` (a value per column) and, on the finest level, the squares of
 * the terms A_kk x_k to `terms`, except for rows without entries, whose values are prescribed; on
 * the finest level both with the share of the row, see residualShare(). Both are summed in node
 * order, so the norm of the residual does not depend on windows or threads. The history and the
 * energy of the iterates, if there are some, get each residual, too, and their flow each unknown.
 * Where what flows is measured, residuals are sums of differences: what rounding of a value takes
 * from a row, it then adds to the rows of neighbours, and a good conductor as a whole is not pushed
 * up or down by it.
 */
template <class Real>
struct Restriction
{
  Ring<float>& coarse;
  Real scale;
  Real *squares, *terms;
  IterateHistory* history;
  IterateEnergy* energy;
  IterateFlow* flow;

  template <class Arrays, class Vectors>
  void operator()(const Arrays& a, Vectors, const BlockPart<Real>& part) const
  {
    ResidualKeeper<Vectors> keeper(this->history, part.header().first, part.lane);
    forResiduals(
      a, part,
      [&](auto residual, const auto& rows, BlockRange nodes)
      { this->restrictNodes<decltype(residual), Vectors>(rows, nodes, part, keeper); },
      this->flow != nullptr);
  }

private:
  template <class Residual, class Vectors, class Arrays>
  void restrictNodes(const Arrays& a, BlockRange nodes, const BlockPart<Real>& part,
    ResidualKeeper<Vectors>& keeper) const
  {
    using CoarseVectors = SimdPack<float, Vectors::count>;
    const RowBlock::Header& h = part.header();
    const std::int64_t stride = Vectors::count == 1 ? 1 : part.stride;
    float* coarseB = this->coarse.at(h.parentBase) + part.lane;
    auto total = Vectors::load(this->squares + part.lane);
    auto termTotal = Vectors::load(this->terms + part.lane);
    for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
    {
      const auto residual = Residual::template of<Vectors>(h, a, k, stride, part.x, part.b);
      keeper(k, residual);
      if constexpr (std::is_same_v<Real, double>)
      {
        const BlockRange row = entriesOf(h, a, k);
        const double share = residualShareOf(h, a, k);
        total += share == 1.0 ? residual * residual : share * residual * (share * residual);
        if (row.begin < row.end)
        {
          const Real* x = part.x + k * stride;
          const auto term = static_cast<Real>(a.diagonal[k]) * Vectors::load(x);
          termTotal += share == 1.0 ? term * term : share * term * (share * term);
          if (this->energy)
          {
            this->energy->template add<Vectors>(
              x, part.b + k * stride, residual, RowBlock::rowSumOf(h, a, k), part.lane);
          }
          if (this->flow)
          {
            this->flow->template add<Vectors>(
              h, a, k, stride, part.x, part.b, residual, share, part.lane);
          }
        }
      }
      else
      {
        total += residual * residual;
      }
      // Scaled before it is rounded to single precision: the scale keeps it near 1.
      const auto coarse =
        __builtin_convertvector(residual * this->scale, typename CoarseVectors::Vector);
      const BlockRange parents = parentsOf(h, a, k);
      for (std::int64_t p = parents.begin; p < parents.end; ++p)
      {
        float* target = coarseB + a.parent[p] * stride;
        const float weight = static_cast<float>(a.parentQuanta[p]) * Quantum;
        CoarseVectors::store(target, CoarseVectors::load(target) + weight * coarse);
      }
    }
    Vectors::store(this->squares + part.lane, total);
    Vectors::store(this->terms + part.lane, termTotal);
  }
};

} // namespace smg
