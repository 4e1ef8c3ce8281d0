// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Cycle/RowBlockPacker.h"

#include <cstdlib>
#include <limits>

namespace smg
{
namespace
{

using Header = RowBlock::Header;

// What a WideIndex holds.
static_assert(RowEntry::MostDistance < (1 << 23) && CoarseWindow <= (1 << 23));

/** Measures the block: its counts, reaches, and whether it fits narrow indices. */
Header measure(
  const LevelRows& rows, const CoarseningData* coarsening, std::int64_t first, std::int64_t nodes)
{
  Header h;
  h.first = first;
  h.nodes = static_cast<std::int32_t>(nodes);
  std::int64_t largestDelta = 0, largestParent = 0, largestCount = 0;
  bool based = false;
  for (std::int64_t k = 0; k < nodes; ++k)
  {
    const std::int64_t i = first + k;
    const auto group = static_cast<std::size_t>(k / RowBlock::Group);
    if (k % RowBlock::Group == 0)
    {
      h.entryStart[group] = h.entries;
      h.parentStart[group] = h.parents;
    }
    const auto row = rows.row(i);
    if (!row.empty())
    {
      largestDelta = std::max<std::int64_t>(
        { largestDelta, std::abs(row.front().delta()), std::abs(row.back().delta()) });
    }
    h.entries += static_cast<std::int32_t>(row.size());
    if (rows.alpha(i) != 0.0)
    {
      h.alphaGroups = static_cast<std::uint16_t>(h.alphaGroups | 1U << group);
    }
    h.neighbourReach[group] = rows.reach(i);
    h.childReach[group] = rows.childReach(i);
    h.parentReach[group] = -1;
    if (coarsening)
    {
      const InterpolationEntry* p = coarsening->interpolation.row(i);
      const std::int64_t count = coarsening->interpolation.size(i);
      if (count > 0 && !based)
      {
        h.parentBase = coarsening->coarseNodes + p->offset(coarsening->coarseNodes);
        based = true;
      }
      for (std::int64_t e = 0; e < count; ++e)
      {
        largestParent = std::max<std::int64_t>(largestParent, std::abs(p[e].offset(h.parentBase)));
      }
      h.parents += static_cast<std::int32_t>(count);
      h.parentReach[group] = coarsening->parentReach[i];
    }
    largestCount = std::max<std::int64_t>(
      { largestCount, h.entries - h.entryStart[group], h.parents - h.parentStart[group] });
  }
  constexpr std::int64_t narrow = std::numeric_limits<std::int16_t>::max();
  h.wide = largestDelta > narrow || largestParent > narrow || largestCount > 2 * narrow ? 1 : 0;
  return h;
}

template <class Index, class Weight>
void fill(RowBlock& block, const LevelRows& rows, const CoarseningData* coarsening)
{
  const Header& h = block.header();
  const auto a = block.arrays<Index, Weight>();
  using Count = typename RowBlock::Arrays<Index, Weight>::Count;
  // The arrays are constant for those who use a block; here it is made.
  auto* alpha = const_cast<double*>(a.alpha);
  auto* weight = const_cast<Weight*>(a.weight);
  auto* delta = const_cast<Index*>(a.delta);
  auto* parent = const_cast<Index*>(a.parent);
  auto* entryEnd = const_cast<Count*>(a.entryEnd);
  auto* parentEnd = const_cast<Count*>(a.parentEnd);
  auto* quanta = const_cast<std::uint8_t*>(a.parentQuanta);
  std::int32_t entries = 0, parents = 0;
  for (std::int64_t k = 0; k < h.nodes; ++k)
  {
    const std::int64_t i = h.first + k;
    const auto group = static_cast<std::size_t>(k / RowBlock::Group);
    if (h.alphaGroups >> group & 1)
    {
      *alpha++ = rows.alpha(i);
    }
    for (const RowEntry& entry : rows.row(i))
    {
      weight[entries] = Weight(entry.weight());
      delta[entries++] = static_cast<Index>(entry.delta());
    }
    entryEnd[k] = static_cast<Count>(entries - h.entryStart[group]);
    if (coarsening)
    {
      const InterpolationEntry* p = coarsening->interpolation.row(i);
      const InterpolationEntry* end = p + coarsening->interpolation.size(i);
      for (; p != end; ++p)
      {
        parent[parents] = static_cast<Index>(p->offset(h.parentBase));
        quanta[parents++] = static_cast<std::uint8_t>(p->quanta());
      }
    }
    parentEnd[k] = static_cast<Count>(parents - h.parentStart[group]);
  }
}

} // namespace

template <class Weight>
RowBlock packRows(SpareBuffers& buffers, const LevelRows& rows, const CoarseningData* coarsening,
  std::int64_t first, std::int64_t nodes)
{
  Header header = measure(rows, coarsening, first, nodes);
  header.weightBytes = sizeof(Weight);
  Buffer buffer = buffers.take(RowBlock::storedBytes(header) + RowBlock::diagonalBytes(nodes));
  std::fill_n(buffer.data(), buffer.size(), std::byte{});
  *reinterpret_cast<Header*>(buffer.data()) = header;
  RowBlock block(std::move(buffer));
  if (header.wide)
  {
    fill<WideIndex, Weight>(block, rows, coarsening);
  }
  else
  {
    fill<std::int16_t, Weight>(block, rows, coarsening);
  }
  block.sumDiagonals();
  return block;
}

template RowBlock packRows<float>(
  SpareBuffers&, const LevelRows&, const CoarseningData*, std::int64_t, std::int64_t);
template RowBlock packRows<BFloat16>(
  SpareBuffers&, const LevelRows&, const CoarseningData*, std::int64_t, std::int64_t);

} // namespace smg
