// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace smg
{

/** Calls plain(range) for the subranges of `nodes` without special nodes, and special(node) for
 * each special node, in order. */
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

/** The special node with index `node` of a block, which must exist. */
template <class Arrays>
const RowBlock::Special& specialOf(const RowBlock::Header& h, const Arrays& a, std::int64_t node)
{
  return *std::lower_bound(a.special, a.special + h.specials, node,
    [](const RowBlock::Special& s, std::int64_t n) { return s.node < n; });
}

/** Calls f(arrays) with the arrays of the weights of row k, which is special: on the finest level
 * (Real is double) they may be the additional weights in double precision. */
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
