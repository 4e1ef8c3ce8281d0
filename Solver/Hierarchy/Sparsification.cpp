// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Hierarchy/Sparsification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace smg
{
namespace
{

constexpr float Removed = std::numeric_limits<float>::quiet_NaN();

std::span<RowEntry> rawRow(const CoarseningData& data, std::int64_t c)
{
  return { data.raw.row(c), static_cast<std::size_t>(data.raw.size(c)) };
}

/** The entry of a row with the column `delta`, which is there. */
RowEntry& find(std::span<RowEntry> row, std::int64_t delta)
{
  return *std::lower_bound(row.begin(), row.end(), delta,
    [](const RowEntry& entry, std::int64_t value) { return entry.delta < value; });
}

} // namespace

void Sparsification::operator()(CoarseningData& data, std::int64_t c) const
{
  const float limit = this->tolerance * data.rawStrongest[c];
  const auto isSmall = [&](float weight, float rowLimit, std::int64_t column) {
    return !(std::fabs(weight) >= std::min(rowLimit, this->tolerance * data.rawStrongest[column]));
  };

  const std::span<RowEntry> row = rawRow(data, c);
  CoarseningData::Slot* slots = data.slots.at(c);
  std::uint32_t mark = 0;
  for (auto entry = row.begin() + data.rawLower[c]; entry != row.end(); ++entry)
  {
    const std::int64_t k = c + entry->delta;
    const float weight = entry->weight;
    if (!(std::fabs(weight) < std::min(limit, this->tolerance * data.rawStrongest[k])))
    {
      continue;
    }
    const std::span<RowEntry> other = rawRow(data, k);
    if (weight <= 0.0F)
    {
      entry->weight = find(other, c - k).weight = Removed;
      continue;
    }
    if (mark == 0)
    {
      mark = data.freshMark();
      for (std::uint32_t e = 0; e < row.size(); ++e)
      {
        CoarseningData::Slot& slot = slots[row[e].delta];
        slot.mark = isSmall(row[e].weight, limit, c + row[e].delta) ? 0 : mark;
        slot.place = e;
      }
    }
    const float otherLimit = this->tolerance * data.rawStrongest[k];
    const CoarseningData::Slot* otherSlots = slots + entry->delta;
    float best = 0.0F;
    RowEntry* bestOther = nullptr;
    for (RowEntry& candidate : other)
    {
      const CoarseningData::Slot& slot = otherSlots[candidate.delta];
      if (slot.mark != mark || isSmall(candidate.weight, otherLimit, k + candidate.delta))
      {
        continue;
      }
      const float value = std::min(row[slot.place].weight, candidate.weight);
      if (value > best)
      {
        best = value;
        bestOther = &candidate;
      }
    }
    if (!bestOther)
    {
      continue;
    }
    const std::int64_t m = k + bestOther->delta;
    const std::span<RowEntry> middle = rawRow(data, m);
    entry->weight = find(other, c - k).weight = Removed;
    row[otherSlots[bestOther->delta].place].weight += weight;
    bestOther->weight += weight;
    find(middle, c - m).weight += weight;
    find(middle, k - m).weight += weight;
  }
}

} // namespace smg
