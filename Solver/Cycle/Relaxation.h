// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/GaussSeidel.h"
#include "Solver/Cycle/Lanes.h"
#include "Solver/Cycle/RowBlock.h"

#include <concepts>
#include <cstdint>

namespace smg
{

/** That R has the sweep that Relaxation describes, for one kind of numbers and blocks. */
template <class R, class Real, int Count, class Index, class Weight>
concept RelaxesBlocks = requires(const RowBlock::Header& h,
  const RowBlock::Arrays<Index, Weight>& a, BlockRange nodes, std::int64_t stride, Real* x,
  const Real* b)
{
  R::template sweep<false, Lanes<Real, Count>>(h, a, nodes, stride, x, b);
  R::template sweep<true, Lanes<Real, Count>>(h, a, nodes, stride, x, b);
};

/** The same for all blocks of such levels. */
template <class R, class Real, class Weight>
concept RelaxesLevels = RelaxesBlocks<R, Real, 1, std::int16_t, Weight> &&
  RelaxesBlocks<R, Real, 4, std::int16_t, Weight> && RelaxesBlocks<R, Real, 1, WideIndex, Weight> &&
  RelaxesBlocks<R, Real, 4, WideIndex, Weight>;

/**
 * A relaxation of A x = b: what smooths the error on every level, before and after the correction
 * from the coarser one. A type R with a static function template
 *
 *   template <bool LowerOnly, class Vectors, ...>
 *   static void sweep(const auto& h, const auto& a, BlockRange nodes, std::int64_t stride,
 *     auto* x, const auto* b);
 *
 * that does nodes [nodes.begin, nodes.end) of a block once. `h` and `a` are the block's rows: see
 * RowBlock, and entriesOf() and neighbourSum() for what is in them. x and b point to node 0 of the
 * block, node k has its values at x + k * stride; they are `double` on the finest level, `float` on
 * the others; weights are double, float or BFloat16, to be made Real by a static_cast.
 * Vectors::load and ::store move the values that are treated at once, 1 or 4 right-hand sides.
 * GaussSeidel is the model.
 *
 * Patches of strongly coupled nodes the engine relaxes by itself (see PatchRelaxation.h).
 *
 * What the streaming engine asks of a sweep:
 *
 * - It treats the nodes one after the other in ascending order, and of node k changes x alone. The
 *   engine cuts a level into ranges as its windows allow, so the result must not depend on where.
 * - Node k may read b and the row of its own and x of itself and its neighbours, nothing else: only
 *   these are sure to be in memory. The neighbours below k bear what this sweep has given them, and
 *   those above what the one before has. So a sweep that needs the old values of all neighbours
 *   (Jacobi) or runs backwards is none: it would need a second x or the end of the stream.
 * - With LowerOnly, the first sweep on a coarse level, x is to be taken as zero for k itself and
 * all nodes above. In memory there are other values or none.
 * - It keeps nothing between two calls: two threads are at two ranges at once.
 *
 * For the V-cycle to converge, the sweep must reduce the error of every symmetric positive definite
 * A (SOR: a factor between 0 and 2).
 */
template <class R>
concept Relaxation = RelaxesLevels<R, double, float> && RelaxesLevels<R, double, double> &&
  RelaxesLevels<R, float, float> && RelaxesLevels<R, float, BFloat16>;

/**
 * sum_j w_ij x_j over the neighbours j of node k, or over those below k. For a sweep of your own:
 * the x that solves row k is (b_k + neighbourSum) / a.diagonal[k].
 */
template <bool LowerOnly, class Vectors, class Real, class Arrays>
[[gnu::always_inline]] inline typename Vectors::Vector neighbourSum(
  const RowBlock::Header& h, const Arrays& a, std::int64_t k, std::int64_t stride, const Real* x)
{
  const BlockRange row = entriesOf(h, a, k);
  const Real* xk = x + k * stride;
  typename Vectors::Vector sum{};
  for (std::int64_t e = row.begin; e < row.end && !(LowerOnly && a.delta[e] > 0); ++e)
  {
    sum += static_cast<Real>(a.weight[e]) * Vectors::load(xk + a.delta[e] * stride);
  }
  return sum;
}

static_assert(Relaxation<GaussSeidel>);

} // namespace smg
