// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/GalerkinProduct.h"

#include <algorithm>
#include <cmath>

// The coarse operator A_c = P^T A P, in two steps that work row by row with a sparse accumulator
// (Slot) instead of a hash table:
//
//   A P, row i:      A_ii P_i - sum_j w_ij P_j         once P of i and its neighbours is final,
//   P^T A P, row c:  sum_i P_ic (A P)_i, i the children of c    once the rows of A P exist.
//
// Row sums. With q_i the sum of row i of P in quanta, an integer, row i of A P sums to
// (rowSum_i q_i + sum_j w_ij (q_i - q_j)) / Quanta: where no constraint reaches, every term is
// exactly zero, whatever the rounding of the entries of A P.
//
// Order. The children of a coarse node are chained in stream order, and entries are added in that
// order. The bits of the product therefore depend neither on the window nor on the threads.
//
// Cost. Row i of A P adds up 1 + deg(i) rows of P, row c of P^T A P one row of A P for each child.
// On the finest level this is most of the set-up.

namespace smg
{
namespace
{

/** The data of `columns`, grown to at least `count` elements. It never shrinks, since growing
 * again would clear elements that are about to be overwritten. */
std::int32_t* roomFor(std::vector<std::int32_t>& columns, std::int64_t count)
{
  const auto size = static_cast<std::size_t>(count);
  columns.resize(std::max(columns.size(), size));
  return columns.data();
}

} // namespace

void GalerkinProduct::productAP(CoarseningData& data, std::int64_t i)
{
  // Columns are distances from `near`, the end of the coarse nodes that this stage knows. In a
  // mirrored ring all slots in memory are contiguous around that of `near`.
  const std::int64_t near = data.interpolatedCoarse;
  Slot* slots = data.productSlots.at(near);
  const auto interpolation = data.interpolation.near(i);
  // Row i of A P is used only through row i of P. Without parents, as for prescribed nodes, it is
  // not needed.
  if (interpolation[0].empty())
  {
    data.product.open(0);
    data.product.close(0);
    data.productSum[i] = 0.0F;
    return;
  }
  const auto row = data.fine.row(i);
  const std::uint32_t mark = data.productSlots.freshMark();
  std::int64_t size = 0;
  std::int32_t* columns =
    roomFor(this->RowColumns, ChildLink::Slots * (static_cast<std::int64_t>(row.size()) + 1));

  const float diagonal = data.patches.diagonal(i);
  // The columns of a row of P are distinct, so each is new here, and add() need not be asked.
  for (const InterpolationEntry& p : interpolation[0])
  {
    const std::int32_t distance = p.offset(near);
    slots[distance].add(mark, diagonal * p.weight());
    columns[size++] = distance;
  }
  const std::int16_t* quanta = data.rowQuanta.at(i);
  const std::int32_t ownQuanta = *quanta;
  double sum = data.fine.rowSum(i) * ownQuanta;
  for (const RowEntry& entry : row)
  {
    const std::int32_t delta = entry.delta();
    const float weight = entry.weight();
    // A difference of integers: exactly zero where both rows of P sum to 1.
    sum += static_cast<double>(weight) * (ownQuanta - quanta[delta]);
    for (const InterpolationEntry& p : interpolation[delta])
    {
      const std::int32_t distance = p.offset(near);
      // The column is written in any case and kept only if it is new: no branch.
      columns[size] = distance;
      size += slots[distance].add(mark, -weight * p.weight()) ? 1 : 0;
    }
  }
  CoarseEntry* out = data.product.open(size);
  for (std::int64_t e = 0; e < size; ++e)
  {
    out[e] = { static_cast<CoarseIndex>(near + columns[e]), slots[columns[e]].value };
  }
  data.product.close(size);
  data.productSum[i] = static_cast<float>(sum / Quanta);
}

void GalerkinProduct::sort(std::size_t size)
{
  this->Sorted.resize(size);
  // Above this the quadratic number of comparisons below would be too many.
  if (size > 128)
  {
    std::copy_n(this->Columns.begin(), size, this->Sorted.begin());
    std::sort(this->Sorted.begin(), this->Sorted.end());
    return;
  }
  // Few and distinct: the rank of each is the number of smaller ones, a loop without branches that
  // can be vectorised.
  const std::int32_t* columns = this->Columns.data();
  for (std::size_t a = 0; a < size; ++a)
  {
    const std::int32_t column = columns[a];
    std::int32_t rank = 0;
    for (std::size_t b = 0; b < size; ++b)
    {
      rank += columns[b] < column ? 1 : 0;
    }
    this->Sorted[static_cast<std::size_t>(rank)] = column;
  }
}

double GalerkinProduct::findChildren(const CoarseningData& data, std::int64_t c)
{
  this->Children.clear();
  double rowSum = 0.0;
  // The C-point of c is in memory and close to all children; their links are relative to it.
  const std::int64_t nearFine = data.finePoint[c];
  for (ChildLink link = data.firstChild[c]; !link.none();)
  {
    const std::int64_t fine = link.row(nearFine);
    const InterpolationEntry& entry = data.interpolation.row(fine)[link.slot()];
    const CoarseEntry* product = data.product.row(fine);
    // The first cache lines of the row of A P are requested while the chain is followed; 10 entries
    // of seven bytes are a bit more than a line.
    for (int line = 0; line < 2; ++line)
    {
      __builtin_prefetch(product + 10 * line);
    }
    this->Children.push_back({ product, data.product.size(fine), entry.weight() });
    // In double precision, from the row sums of A P, not from its entries.
    rowSum += static_cast<double>(entry.quanta()) / Quanta * data.productSum[fine];
    link = entry.next;
  }
  return rowSum;
}

void GalerkinProduct::productPtAP(CoarseningData& data, std::int64_t c)
{
  const double rowSum = this->findChildren(data, c);
  Slot* slots = data.gatherSlots.at(c);
  const std::uint32_t mark = data.gatherSlots.freshMark();
  std::int64_t columns = 0;
  for (const Child& child : this->Children)
  {
    std::int32_t* column = roomFor(this->Columns, columns + child.size);
    const CoarseEntry* end = child.product + child.size;
    for (const CoarseEntry* entry = child.product; entry != end; ++entry)
    {
      const std::int32_t delta = entry->offset(c);
      column[columns] = delta;
      columns += slots[delta].add(mark, child.weight * entry->value()) ? 1 : 0;
    }
  }
  // finishRow() and the search for mirrored entries rely on ascending columns.
  this->sort(static_cast<std::size_t>(columns));
  this->append(data, c, rowSum);
}

void GalerkinProduct::append(CoarseningData& data, std::int64_t c, double rowSum)
{
  const Slot* slots = data.gatherSlots.at(c);
  CoarseEntry* out = data.gathered.open(static_cast<std::int64_t>(this->Sorted.size()));
  std::int32_t lower = 0;
  std::int64_t size = 0;
  float strongest = 0.0F, least = 0.0F;
  double sum = rowSum, terms = 0.0;
  for (const std::int32_t delta : this->Sorted)
  {
    // The diagonal that was accumulated is left out: the diagonal of a row is its row sum plus its
    // weights, so that rounding cannot disturb the row sum.
    if (delta != 0)
    {
      const float weight = -slots[delta].value;
      out[size++] = { static_cast<CoarseIndex>(c + delta), weight };
      lower += delta < 0 ? 1 : 0;
      strongest = std::max(strongest, weight);
      least = std::min(least, weight);
      sum += weight;
      terms += std::fabs(weight);
    }
  }
  // Once per row, in order: SliverRows limits the share of stiff rows so far.
  const bool stiff = data.stiff(least);
  // Where large weights cancel, small entries decide the soft modes: keep all of them.
  data.gathered.close({ size, rowSum, static_cast<float>(nonZeroDiagonal(sum)),
    { strongest, stiff }, lower, stiff || terms > this->cancelling * sum });
}

} // namespace smg
