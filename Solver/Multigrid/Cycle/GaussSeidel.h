// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"

#include <concepts>
#include <cstdint>
#include <limits>

namespace smg
{

/** Forward Gauss-Seidel in stream order: x_i = (b_i + sum_j w_ij x_j) / A_ii, in place. x and b
 * point to node 0 of the block and have `stride` values per node. A node reads only its
 * neighbours, so any division of a level into ranges, in whichever windows, gives the same
 * bits. */
struct GaussSeidel
{
  /** LowerOnly: x is zero above each node, as in the first sweep on a coarse level, and is not
   * read there. */
  template <bool LowerOnly, class Vectors, class Real, class Arrays>
  static void sweep(const RowBlock::Header& h, const Arrays& a, BlockRange nodes,
    std::int64_t stride, Real* x, const Real* b)
  {
    for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
    {
      const RowView row(h, a, k);
      Real* xk = x + k * stride;
      const auto bk = Vectors::load(b + k * stride);
      typename Vectors::Vector sum{};
      if constexpr (LowerOnly)
      {
        sum += row.template plusProductsBelow<Vectors>(0, bk, xk, stride);
      }
      else
      {
        sum = row.template plusProducts<Vectors>(bk, xk, stride);
      }
      Vectors::store(xk, sum * static_cast<Real>(1.0 / row.diagonal));
    }
  }
};

/** Whether R has the sweep that is described at Relaxation, for this number of values per node,
 * type of numbers and type of blocks. */
template <class R, class Real, int Count, class Index, class Weight>
concept RelaxesBlocks = requires(const RowBlock::Header& h,
  const RowBlock::Arrays<Index, Weight>& a, BlockRange nodes, std::int64_t stride, Real* x,
  const Real* b)
{
  R::template sweep<false, SimdPack<Real, Count>>(h, a, nodes, stride, x, b);
  R::template sweep<true, SimdPack<Real, Count>>(h, a, nodes, stride, x, b);
};

/** The same for every kind of block that levels with these numbers and weights have. */
template <class R, class Real, class Weight>
concept RelaxesLevels = RelaxesBlocks<R, Real, 1, std::int16_t, Weight> &&
  RelaxesBlocks<R, Real, 4, std::int16_t, Weight> && RelaxesBlocks<R, Real, 1, WideIndex, Weight> &&
  RelaxesBlocks<R, Real, 4, WideIndex, Weight>;

/**
 * A relaxation (smoother) of A x = b, applied on every level but the coarsest, before and after the
 * correction from the coarser one. A type R with a static function template
 *
 *   template <bool LowerOnly, class Vectors, ...>
 *   static void sweep(const auto& h, const auto& a, BlockRange nodes, std::int64_t stride,
 *     auto* x, const auto* b);
 *
 * that relaxes nodes [nodes.begin, nodes.end) of a block once. `h` and `a` are the rows of the
 * block: see RowBlock, entriesOf() and neighbourSum(). x and b point to node 0 of the block; the
 * values of node k are at x + k * stride. They are `double` on the finest level, `float` on the
 * others. Weights are double, float or BFloat16, and are converted by static_cast<Real>.
 * Vectors::load and ::store move 1 or 4 right-hand sides at a time. GaussSeidel is the model.
 *
 * The engine itself relaxes patches of strongly coupled nodes (see Sweep.h).
 *
 * What the streaming engine requires:
 *
 * - A sweep relaxes the nodes in ascending order and modifies x of node k only. The engine splits a
 *   level into ranges according to its windows; the result must not depend on the ranges.
 * - Node k may read its own b and row, and x of itself and its neighbours, and nothing else: only
 *   these are guaranteed to be in memory. Neighbours below k have the values of this sweep, those
 *   above k the values of the sweep before. Sweeps that need the old values of all neighbours
 *   (Jacobi) or run backwards are not possible: they would need a second x, or the end of the
 *   stream first.
 * - With LowerOnly, the first sweep on a coarse level, x must be taken as zero for k itself and all
 *   nodes above, whose memory is uninitialised or absent.
 * - A sweep keeps no state between calls, since two threads may process two ranges at the same
 *   time.
 *
 * For the V-cycle to converge, the sweep must reduce the error for every symmetric positive
 * definite A (SOR: a factor between 0 and 2).
 */
template <class R>
concept Relaxation = RelaxesLevels<R, double, float> && RelaxesLevels<R, double, double> &&
  RelaxesLevels<R, float, float> && RelaxesLevels<R, float, BFloat16>;

/** sum_j w_kj x_j over the neighbours j of node k, or over those below k. For sweeps of
 * programs: the x that solves row k is (b_k + neighbourSum) / a.diagonal[k]. */
template <bool LowerOnly, class Vectors, class Real, class Arrays>
[[gnu::always_inline]] inline typename Vectors::Vector neighbourSum(
  const RowBlock::Header& h, const Arrays& a, std::int64_t k, std::int64_t stride, const Real* x)
{
  constexpr std::int64_t End = LowerOnly ? 0 : std::numeric_limits<std::int64_t>::max();
  const typename Vectors::Vector zero{};
  return RowView(h, a, k).template plusProductsBelow<Vectors>(End, zero, x + k * stride, stride);
}

static_assert(Relaxation<GaussSeidel>);

} // namespace smg
