// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/RowBlockPacker.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

// Packs rows of the set-up into the format of the passes. A block is written once and read in every
// later pass, so its bytes count: distances of 16 bits, weights of 2 or 4 bytes, interpolation
// weights of one byte, row sums only for groups that have some.
//
// A block is packed once everything that refers to its rows is known: interpolation, patches of the
// neighbours, and the reaches that the cursors will need. Patches are inverted here, once, so that
// sweeps only multiply.

namespace smg
{
namespace
{

using Header = RowBlock::Header;

// A WideIndex must have room for every distance of rows and of parents.
static_assert(RowEntry::MaxDistance < (1 << 23) && CoarseWindow <= (1 << 23));

/** Limits of PatchMatrix::invert(). The inverse of the matrix on a patch amplifies the rounding
 * of residuals, which are double on the finest level and float on the others, by up to one over
 * these. */
constexpr double MinPivotOfDoubles = 1e-9, MinPivotOfFloats = 1e-5;

/** The special nodes of a block, in the format of the block. */
struct Specials
{
  std::vector<RowBlock::Special> nodes;
  std::vector<double> values, precise;
  /** Whether the block has a stiff row or a special node: its weights are not to be rounded. */
  bool cancelling = false;

  /** Finds the special nodes of the block of these nodes. */
  void find(
    const LevelRows& rows, const CoarseningData* coarsening, std::int64_t first, std::int64_t nodes)
  {
    const bool finest = rows.childReach(first) < 0;
    this->MinPivot = finest ? MinPivotOfDoubles : MinPivotOfFloats;
    for (std::int64_t i = first; i < first + nodes; ++i)
    {
      const Patch* patch = coarsening ? coarsening->patches.of(i) : nullptr;
      const std::span<const double> weights = rows.precise(i);
      const std::int32_t overlapping =
        coarsening && coarsening->overlaps ? this->addOverlapping(coarsening->overlapping, i) : -1;
      this->cancelling = this->cancelling || rows.stiff(i);
      if (!patch && weights.empty() && overlapping < 0)
      {
        continue;
      }
      RowBlock::Special node{ static_cast<std::int16_t>(i - first), 1, 0, -1, overlapping };
      // The inverse is stored once, at the last member, where the sweep relaxes the patch; the
      // others are marked to wait for it.
      if (patch && i < patch->last())
      {
        node.size = 0;
      }
      else if (patch)
      {
        node.size = static_cast<std::int16_t>(patch->size);
        node.value = static_cast<std::int32_t>(this->values.size());
        this->addValues(*patch, coarsening->patchMatrices.of(*patch));
      }
      if (!weights.empty())
      {
        node.precise = static_cast<std::int32_t>(this->precise.size());
        this->precise.insert(this->precise.end(), weights.begin(), weights.end());
      }
      this->nodes.push_back(node);
    }
    this->cancelling = this->cancelling || !this->nodes.empty();
  }

private:
  double MinPivot = MinPivotOfDoubles;

  /** Adds the values of the overlapping patches whose last member is node i. Returns where they
   * begin; -1: there are none. */
  std::int32_t addOverlapping(const OverlappingPatches& overlapping, std::int64_t i)
  {
    const std::size_t begin = this->values.size();
    overlapping.forEndingAt(i,
      [&](const OverlappingPatches::Patch& patch, const double* matrix)
      {
        if (this->values.size() == begin)
        {
          this->values.push_back(0.0);
        }
        this->values[begin] += 1.0;
        this->values.push_back(static_cast<double>(patch.size));
        this->addValues(patch, matrix);
      });
    return this->values.size() > begin ? static_cast<std::int32_t>(begin) : -1;
  }

  /** Adds the values of a patch, at its last node: distances, which are negative, and the
   * inverse. */
  template <int Most>
  void addValues(const PatchUpTo<Most>& patch, const double* matrix)
  {
    for (int k = 0; k + 1 < patch.size; ++k)
    {
      this->values.push_back(static_cast<double>(patch.member(k) - patch.last()));
    }
    const int entries = PatchMatrix::entriesOf(patch.size);
    PatchMatrixUpTo<Most> inverse;
    inverse.order = patch.size;
    std::copy_n(matrix, entries, inverse.entry);
    // Where a pivot is too small this is a generalised inverse, which leaves the node as it is.
    inverse.invert(this->MinPivot);
    this->values.insert(this->values.end(), inverse.entry, inverse.entry + entries);
  }
};

/** Computes the header of the block: its counts, its reaches, and whether its indices fit 16
 * bits. */
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
    if (rows.rowSum(i) != 0.0)
    {
      h.rowSumGroups = static_cast<std::uint16_t>(h.rowSumGroups | 1U << group);
    }
    // Reaches are those of rows 0 .. i: assigned for each row, the last one of the group remains.
    h.neighbourReach[group] = rows.reach(i);
    h.patchReach[group] =
      coarsening ? std::max(rows.reach(i), coarsening->patchReach[i]) : rows.reach(i);
    h.childReach[group] = rows.childReach(i);
    h.parentReach[group] = -1;
    if (coarsening)
    {
      const InterpolationEntry* p = coarsening->interpolation.row(i);
      const std::int64_t count = coarsening->interpolation.size(i);
      // Parents are relative to the first parent of the block, so that distances stay small
      // whatever the shift between the numbers of the two levels. A block without parents keeps
      // base 0, which nothing uses.
      if (count > 0 && !based)
      {
        h.parentBase = coarsening->interpolatedCoarse + p->offset(coarsening->interpolatedCoarse);
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
  // Counts of a group are unsigned, hence twice the range.
  constexpr std::int64_t narrow = std::numeric_limits<std::int16_t>::max();
  h.wide = largestDelta > narrow || largestParent > narrow || largestCount > 2 * narrow ? 1 : 0;
  return h;
}

template <class Index, class Weight>
void fill(RowBlock& block, const LevelRows& rows, const CoarseningData* coarsening,
  const Specials& specials)
{
  const Header& h = block.header();
  const auto a = block.arrays<Index, Weight>();
  using Count = typename RowBlock::Arrays<Index, Weight>::Count;
  // Users of a block see constant arrays; they are filled here.
  auto* rowSum = const_cast<double*>(a.rowSum);
  auto* weight = const_cast<Weight*>(a.weight);
  auto* delta = const_cast<Index*>(a.delta);
  auto* parent = const_cast<Index*>(a.parent);
  auto* entryEnd = const_cast<Count*>(a.entryEnd);
  auto* parentEnd = const_cast<Count*>(a.parentEnd);
  auto* quanta = const_cast<std::int8_t*>(a.parentQuanta);
  std::ranges::copy(specials.nodes, const_cast<RowBlock::Special*>(a.special));
  std::ranges::copy(specials.values, const_cast<double*>(a.value));
  std::ranges::copy(specials.precise, const_cast<double*>(a.precise));
  std::int32_t entries = 0, parents = 0;
  for (std::int64_t k = 0; k < h.nodes; ++k)
  {
    const std::int64_t i = h.first + k;
    const auto group = static_cast<std::size_t>(k / RowBlock::Group);
    // Groups without any non-zero row sum store none.
    if (h.rowSumGroups >> group & 1)
    {
      *rowSum++ = rows.rowSum(i);
    }
    for (const RowEntry& entry : rows.row(i))
    {
      weight[entries] = Weight(entry.weight());
      delta[entries++] = static_cast<Index>(entry.delta());
    }
    // Ends are relative to the group, so that 16 bits suffice.
    entryEnd[k] = static_cast<Count>(entries - h.entryStart[group]);
    if (coarsening)
    {
      const InterpolationEntry* p = coarsening->interpolation.row(i);
      const InterpolationEntry* end = p + coarsening->interpolation.size(i);
      for (; p != end; ++p)
      {
        parent[parents] = static_cast<Index>(p->offset(h.parentBase));
        quanta[parents++] = static_cast<std::int8_t>(p->quanta());
      }
    }
    parentEnd[k] = static_cast<Count>(parents - h.parentStart[group]);
  }
}

template <class Weight>
void fill(RowBlock& block, const LevelRows& rows, const CoarseningData* coarsening,
  const Specials& specials)
{
  if (block.header().wide)
  {
    fill<WideIndex, Weight>(block, rows, coarsening, specials);
  }
  else
  {
    fill<std::int16_t, Weight>(block, rows, coarsening, specials);
  }
}

} // namespace

RowBlock packRows(SpareBuffers& buffers, const LevelRows& rows, const CoarseningData* coarsening,
  std::int64_t first, std::int64_t nodes, bool mayRound)
{
  Specials specials;
  specials.find(rows, coarsening, first, nodes);
  // Rounding to 8 bits would destroy the balance of weights that nearly cancel.
  const bool rounds = mayRound && !specials.cancelling;
  Header header = measure(rows, coarsening, first, nodes);
  header.weightBytes = rounds ? sizeof(BFloat16) : sizeof(float);
  header.specials = static_cast<std::int32_t>(specials.nodes.size());
  header.values = static_cast<std::int32_t>(specials.values.size());
  header.precise = static_cast<std::int32_t>(specials.precise.size());
  Buffer buffer = buffers.take(RowBlock::storedBytes(header) + RowBlock::diagonalBytes(nodes));
  // Also the padding: blocks go to disk, with checksums, and shall be the same in every run.
  std::fill_n(buffer.data(), buffer.size(), std::byte{});
  *reinterpret_cast<Header*>(buffer.data()) = header;
  RowBlock block(std::move(buffer));
  if (rounds)
  {
    fill<BFloat16>(block, rows, coarsening, specials);
  }
  else
  {
    fill<float>(block, rows, coarsening, specials);
  }
  block.sumDiagonals();
  return block;
}

} // namespace smg
