// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/ExtendedInterpolation.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

/** std::lround() of a number of a few digits, without a call: the sum is exact. */
int nearest(float value)
{
  return static_cast<int>(static_cast<double>(value) + std::copysign(0.5, value));
}

} // namespace

void ExtendedInterpolation::initial(CoarseningData& data, std::int64_t i) const
{
  constexpr CoarseIndex Retained = CoarseningData::Retained;
  data.initialTotal.extendRaw(i + 1);
  const CoarseIndex* lifted = data.lifted.at(i);
  if (*lifted != Retained)
  {
    *data.initial.open(1) = { *lifted, 1.0F };
    data.initial.close(1);
    data.initialTotal[i] = 1.0F;
    return;
  }
  const auto row = data.fine.row(i);
  const float strong = this->lifting.threshold(data, i);
  CoarseEntry* out = data.initial.open(static_cast<std::int64_t>(row.size()));
  std::int64_t size = 0;
  const auto alpha = static_cast<float>(std::max(0.0, data.fine.alpha(i)));
  float sum = alpha;
  for (const RowEntry& entry : row)
  {
    const CoarseIndex coarse = lifted[entry.delta()];
    if (coarse != Retained && entry.weight() >= strong)
    {
      out[size++] = { coarse, entry.weight() };
      sum += entry.weight();
    }
  }
  for (std::int64_t e = 0; e < size; ++e)
  {
    out[e].setValue(out[e].value() / sum);
  }
  data.initial.close(size);
  data.initialTotal[i] = sum;
}

/** The maximum number of entries of row i. */
int ExtendedInterpolation::entriesOf(const CoarseningData& data, std::int64_t i) const
{
  const auto row = data.fine.row(i);
  const bool isNextToStiff = std::ranges::any_of(
    row, [&](const RowEntry& entry) { return data.fine.stiff(i + entry.delta()); });
  if (isNextToStiff)
  {
    return RelaxedRow::Most;
  }
  return this->entries == this->finestEntries || data.fine.childReach(i) >= 0 ||
             this->lifting.isOfSlivers(data, i)
           ? this->entries
           : this->finestEntries;
}

/** Makes row i from the largest of the columns, scaled to this sum. */
void ExtendedInterpolation::store(CoarseningData& data, std::int64_t i, double sum)
{
  const auto most = static_cast<std::size_t>(this->entriesOf(data, i));
  Candidate largest[RelaxedRow::Most];
  std::size_t kept = 0;
  for (const Candidate candidate : this->Row)
  {
    const float size = std::fabs(candidate.weight);
    if (kept == most && !(size > std::fabs(largest[kept - 1].weight)))
    {
      continue;
    }
    // In descending order.
    std::size_t place = kept < most ? kept++ : kept - 1;
    for (; place > 0 && std::fabs(largest[place - 1].weight) < size; --place)
    {
      largest[place] = largest[place - 1];
    }
    largest[place] = candidate;
  }
  float keptSum = 0.0F, keptSize = 0.0F;
  for (std::size_t k = 0; k < kept; ++k)
  {
    keptSum += largest[k].weight;
    keptSize += std::fabs(largest[k].weight);
  }
  const auto wanted = static_cast<float>(sum);
  const float share = keptSize > 0.0F ? (wanted - keptSum) / keptSize : 0.0F;
  RelaxedRow& row = data.relaxed[i];
  row.size = keptSize > 0.0F ? static_cast<std::int8_t>(kept) : 0;
  row.sum = row.size > 0 ? wanted : 0.0F;
  for (int k = 0; k < row.size; ++k)
  {
    const Candidate& from = largest[k];
    row.entry[k] = { static_cast<CoarseIndex>(data.seenCoarse + from.distance),
      from.weight + share * std::fabs(from.weight) };
  }
}

void ExtendedInterpolation::append(CoarseningData& data, std::int64_t i) const
{
  const std::int64_t near = data.seenCoarse;
  const RelaxedRow& row = data.relaxed[i];
  int rounded[RelaxedRow::Most];
  int rest = nearest(row.sum * Quanta);
  for (int k = 0; k < row.size; ++k)
  {
    rounded[k] = nearest(std::clamp(row.entry[k].value(), -1.0F, 1.0F) * Quanta);
    rest -= rounded[k];
  }
  // The first entry, the largest, receives the remainder as far as its range permits.
  for (int k = 0; k < row.size && rest != 0; ++k)
  {
    const int taken = std::clamp(rounded[k] + rest, -Quanta, Quanta) - rounded[k];
    rounded[k] += taken;
    rest -= taken;
  }
  InterpolationEntry* out = data.interpolation.open(row.size);
  const auto rows = data.interpolation.near(i);
  ChildLink* firstChild = data.firstChild.at(near);
  ChildLink* lastChild = data.lastChild.at(near);
  int size = 0;
  std::int64_t reach = -1;
  int sum = 0;
  for (int k = 0; k < row.size; ++k)
  {
    if (rounded[k] == 0)
    {
      continue;
    }
    const std::int32_t offset = row.entry[k].offset(near);
    const ChildLink link(i, size);
    ChildLink& last = lastChild[offset];
    (last.none() ? firstChild[offset] : rows[last.distance(i)][last.slot()].next) = link;
    last = link;
    const std::int64_t coarse = near + offset;
    out[size++] = InterpolationEntry(static_cast<CoarseIndex>(coarse), rounded[k]);
    reach = std::max(reach, coarse);
    sum += rounded[k];
  }
  data.interpolation.close(size);
  data.rowQuanta[i] = static_cast<std::int16_t>(sum);
  data.parentReach.append(reach);
}

} // namespace smg
