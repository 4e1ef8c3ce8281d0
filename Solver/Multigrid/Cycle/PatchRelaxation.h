// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/Cycle/Residual.h"
#include "Solver/Multigrid/Setup/Patches.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace smg
{

/** b_k + sum_j w_kj x_j of node k of a block, with x taken as zero for node k and for all nodes
 * from `limit` on. Members of the patch below `limit` are zero at that time. */
template <class Vectors, class Real, class Arrays>
typename Vectors::Vector lowerResidual(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
  std::int64_t limit, std::int64_t stride, const Real* x, const Real* b)
{
  const BlockRange row = entriesOf(h, a, k);
  auto sum = Vectors::load(b + k * stride);
  for (std::int64_t e = row.begin; e < row.end && k + a.delta[e] < limit; ++e)
  {
    sum += static_cast<Real>(a.weight[e]) * Vectors::load(x + (k + a.delta[e]) * stride);
  }
  return sum;
}

/** x += A_bb^-1 (b - A x) on the `size` nodes of a patch, given their residuals and the inverse
 * of the matrix on the patch. x points to the last member; the others are at `distance`.
 * LowerOnly: x of the last member was zero and is not read. */
template <bool LowerOnly, class Vectors, class Real>
void correctPatch(int size, const double* distance, const double* inverse,
  const typename Vectors::Vector* residual, std::int64_t stride, Real* x)
{
  for (int a = 0; a < size; ++a)
  {
    typename Vectors::Vector sum{};
    for (int k = 0; k < size; ++k)
    {
      sum += static_cast<Real>(inverse[PatchMatrix::place(a, k)]) * residual[k];
    }
    Real* at = x + (a + 1 < size ? static_cast<std::int64_t>(distance[a]) : 0) * stride;
    if (!LowerOnly || a + 1 < size)
    {
      sum += Vectors::load(at);
    }
    Vectors::store(at, sum);
  }
}

/** Calls plain(range) for the subranges of `nodes` without special nodes, and special(node) for
 * each special node, in node order. */
template <class Arrays, class Plain, class OfSpecial>
void visitNodes(
  const RowBlock::Header& h, const Arrays& a, BlockRange nodes, Plain&& plain, OfSpecial&& special)
{
  const RowBlock::Special* last = a.special + h.specials;
  const RowBlock::Special* next = std::lower_bound(a.special, last, nodes.begin,
    [](const RowBlock::Special& s, std::int64_t node) { return s.node < node; });
  std::int64_t begin = nodes.begin;
  for (; next != last && next->node < nodes.end; ++next)
  {
    if (begin < next->node)
    {
      plain(BlockRange{ begin, next->node });
    }
    special(*next);
    begin = next->node + 1;
  }
  if (begin < nodes.end)
  {
    plain(BlockRange{ begin, nodes.end });
  }
}

/** The special node with index `node` in the block, which must exist. */
template <class Arrays>
const RowBlock::Special& specialOf(const RowBlock::Header& h, const Arrays& a, std::int64_t node)
{
  return *std::lower_bound(a.special, a.special + h.specials, node,
    [](const RowBlock::Special& s, std::int64_t n) { return s.node < n; });
}

/** Calls f(arrays) with the arrays for the row of a special node: on the finest level (Real is
 * double), its weights may be the additional ones in double precision. */
template <class Real, class Arrays, class F>
void visitSpecial(const RowBlock::Header& h, const Arrays& a, const RowBlock::Special& node, F&& f)
{
  if constexpr (std::is_same_v<Real, double>)
  {
    if (node.precise >= 0)
    {
      f(a.ofPreciseRow(node, entriesOf(h, a, node.node).begin));
      return;
    }
  }
  f(a);
}

} // namespace smg
