// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Hierarchy/GalerkinProduct.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace smg
{

void GalerkinProduct::multiply(CoarseningData& data, std::int64_t i) const
{
  const std::int64_t near = data.coarseNodes;
  CoarseningData::Slot* slots = data.slots.at(near);
  const std::int64_t own = data.interpolation.size(i);
  if (own == 0)
  {
    data.product.open(0);
    data.product.close(0);
    data.productSum[i] = 0.0;
    return;
  }
  const auto row = data.fine.row(i);
  std::int64_t room = own;
  for (const RowEntry& entry : row)
  {
    room += data.interpolation.size(i + entry.delta);
  }
  const std::uint32_t mark = data.freshMark();
  ProductEntry* out = data.product.open(room);
  std::uint32_t size = 0;

  const auto diagonal = static_cast<float>(data.fine.diagonal(i));
  const InterpolationEntry* p = data.interpolation.row(i);
  for (std::int64_t e = 0; e < own; ++e)
  {
    const std::int32_t distance = p[e].offset(near);
    CoarseningData::Slot& slot = slots[distance];
    slot.mark = mark;
    slot.place = size;
    out[size++] = { static_cast<CoarseIndex>(near + distance), diagonal * p[e].weight() };
  }
  const std::int32_t ownQuanta = data.rowQuanta[i];
  double sum = data.fine.alpha(i) * ownQuanta;
  for (const RowEntry& entry : row)
  {
    const std::int64_t j = i + entry.delta;
    sum += static_cast<double>(entry.weight) * (ownQuanta - data.rowQuanta[j]);
    p = data.interpolation.row(j);
    const InterpolationEntry* end = p + data.interpolation.size(j);
    for (; p != end; ++p)
    {
      const std::int32_t distance = p->offset(near);
      CoarseningData::Slot& slot = slots[distance];
      const float value = -entry.weight * p->weight();
      if (slot.mark != mark)
      {
        slot.mark = mark;
        slot.place = size;
        out[size++] = { static_cast<CoarseIndex>(near + distance), value };
      }
      else
      {
        out[slot.place].value += value;
      }
    }
  }
  data.product.close(size);
  data.productSum[i] = sum / Quanta;
}

void GalerkinProduct::sort()
{
  const std::size_t size = this->Columns.size();
  this->Sorted.resize(size);
  if (size > 64)
  {
    this->Sorted = this->Columns;
    std::sort(this->Sorted.begin(), this->Sorted.end());
    return;
  }
  // Few and distinct: the rank of each is the number of smaller ones, which vectorises.
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

void GalerkinProduct::gather(CoarseningData& data, std::int64_t c)
{
  CoarseningData::Slot* slots = data.slots.at(c);
  const std::uint32_t mark = data.freshMark();
  const std::int64_t nearFine = data.liftedFrom[c];
  this->Columns.clear();
  double alpha = 0.0;
  for (ChildLink link = data.firstChild[c]; !link.none();)
  {
    const std::int64_t fine = link.row(nearFine);
    const InterpolationEntry& child = data.interpolation.row(fine)[link.slot()];
    const float weight = child.weight();
    alpha += static_cast<double>(child.quanta()) / Quanta * data.productSum[fine];
    const ProductEntry* entry = data.product.row(fine);
    const ProductEntry* end = entry + data.product.size(fine);
    for (; entry != end; ++entry)
    {
      const std::int32_t delta = offset(entry->coarse, c);
      CoarseningData::Slot& slot = slots[delta];
      const float value = weight * entry->value;
      if (slot.mark != mark)
      {
        slot.mark = mark;
        slot.value = value;
        this->Columns.push_back(delta);
      }
      else
      {
        slot.value += value;
      }
    }
    link = child.next;
  }
  this->sort();

  RowEntry* out = data.raw.open(static_cast<std::int64_t>(this->Sorted.size()));
  std::int64_t size = 0;
  std::int32_t lower = 0;
  float strongest = 0.0F;
  for (const std::int32_t delta : this->Sorted)
  {
    if (delta == 0)
    {
      continue;
    }
    float weight = -slots[delta].value;
    if (delta < 0)
    {
      const std::int64_t k = c + delta;
      const RowEntry& mirror = data.raw.row(k)[data.rawLower[k] + data.rawFilled[k]++];
      assert(mirror.delta == -delta);
      weight = mirror.weight;
      ++lower;
    }
    out[size++] = { delta, weight };
    strongest = std::max(strongest, weight);
  }
  data.raw.close(size);
  data.rawAlpha[c] = alpha;
  data.rawStrongest[c] = strongest;
  data.rawLower[c] = lower;
  data.rawFilled[c] = 0;
  data.rawReach[c] = size > 0 ? std::max(0, out[size - 1].delta) : 0;
}

} // namespace smg
