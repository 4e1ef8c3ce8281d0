// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Residual.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <type_traits>

namespace smg
{

/** Prolongation to the nodes of a block: x += scale P x_coarse. coarseX points to coarse node
 * parentBase, to which the parents of the block are relative. */
template <class Vectors, class CoarseVectors, class Real, class Arrays>
void prolong(const RowBlock::Header& h, const Arrays& a, BlockRange nodes, std::int64_t stride,
  Real* x, const float* coarseX, Real scale)
{
  for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
  {
    const BlockRange row = parentsOf(h, a, k);
    auto sum = Vectors::load(x + k * stride);
    for (std::int64_t e = row.begin; e < row.end; ++e)
    {
      const auto value = CoarseVectors::load(coarseX + a.parent[e] * stride);
      const float weight = static_cast<float>(a.parentQuanta[e]) * Quantum;
      // On the finest level the product is formed in double precision: the coarse correction is a
      // float, the sum is not.
      sum += (static_cast<Real>(weight) * scale) *
             __builtin_convertvector(value, typename Vectors::Vector);
    }
    Vectors::store(x + k * stride, sum);
  }
}

/**
 * Residual and restriction for the nodes of a block: r = b - A x, computed by `Residual`, and
 * b_coarse += scale P^T r. coarseB points to coarse node parentBase.
 *
 * Adds the squares of r to `squares` (`stride` values) and, on the finest level, the squares of the
 * terms A_kk x_k to `terms`, except for rows without entries, whose values are prescribed. Both are
 * summed in node order, so the norm of the residual does not depend on windows or threads. Calls
 * keep(k, r) for each node k.
 */
template <class Residual, class Vectors, class CoarseVectors, class Real, class Arrays, class Keep>
void restrictResidual(const RowBlock::Header& h, const Arrays& a, BlockRange nodes,
  std::int64_t stride, const Real* x, const Real* b, float* coarseB, Real scale, Real* squares,
  Real* terms, Keep&& keep)
{
  auto total = Vectors::load(squares);
  auto termTotal = Vectors::load(terms);
  for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
  {
    const auto residual = Residual::template of<Vectors>(h, a, k, stride, x, b);
    total += residual * residual;
    const BlockRange row = entriesOf(h, a, k);
    if (std::is_same_v<Real, double> && row.begin < row.end)
    {
      const auto term = static_cast<Real>(a.diagonal[k]) * Vectors::load(x + k * stride);
      termTotal += term * term;
    }
    keep(k, residual);
    // Scaled before it is rounded to single precision: the scale keeps it near 1.
    const auto coarse = __builtin_convertvector(residual * scale, typename CoarseVectors::Vector);
    const BlockRange parents = parentsOf(h, a, k);
    for (std::int64_t p = parents.begin; p < parents.end; ++p)
    {
      float* target = coarseB + a.parent[p] * stride;
      const float weight = static_cast<float>(a.parentQuanta[p]) * Quantum;
      CoarseVectors::store(target, CoarseVectors::load(target) + weight * coarse);
    }
  }
  Vectors::store(squares, total);
  Vectors::store(terms, termTotal);
}

} // namespace smg
