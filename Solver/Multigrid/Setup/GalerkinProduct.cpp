// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/GalerkinProduct.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

/** Columns, with room for at least so many. */
std::int32_t* roomFor(std::vector<std::int32_t>& columns, std::int64_t count)
{
  const auto size = static_cast<std::size_t>(count);
  columns.resize(std::max(columns.size(), size));
  return columns.data();
}

} // namespace

void GalerkinProduct::productAP(CoarseningData& data, std::int64_t i)
{
  const std::int64_t near = data.knownCoarse;
  Slot* slots = data.productSlots.at(near);
  const auto interpolation = data.interpolation.near(i);
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
    sum += static_cast<double>(weight) * (ownQuanta - quanta[delta]);
    for (const InterpolationEntry& p : interpolation[delta])
    {
      const std::int32_t distance = p.offset(near);
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
  if (size > 128)
  {
    std::copy_n(this->Columns.begin(), size, this->Sorted.begin());
    std::sort(this->Sorted.begin(), this->Sorted.end());
    return;
  }
  // Few and distinct: the rank of each is the number of smaller ones, which can be vectorised.
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
  const std::int64_t nearFine = data.finePoint[c];
  for (ChildLink link = data.firstChild[c]; !link.none();)
  {
    const std::int64_t fine = link.row(nearFine);
    const InterpolationEntry& entry = data.interpolation.row(fine)[link.slot()];
    const CoarseEntry* product = data.product.row(fine);
    for (int line = 0; line < 2; ++line)
    {
      __builtin_prefetch(product + 10 * line);
    }
    this->Children.push_back({ product, data.product.size(fine), entry.weight() });
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
  const bool stiff = data.stiff(least);
  data.gathered.close({ size, rowSum, static_cast<float>(nonZeroDiagonal(sum)),
    { strongest, stiff }, lower, stiff || terms > this->cancelling * sum });
}

} // namespace smg
