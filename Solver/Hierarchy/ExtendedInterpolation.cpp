// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Hierarchy/ExtendedInterpolation.h"

#include <algorithm>

namespace smg
{

void ExtendedInterpolation::initial(CoarseningData& data, std::int64_t i) const
{
  constexpr CoarseIndex Retained = CoarseningData::Retained;
  const CoarseIndex* lifted = data.lifted.at(i);
  if (*lifted != Retained)
  {
    *data.initial.open(1) = { *lifted, 1.0F };
    data.initial.close(1);
    return;
  }
  const auto row = data.fine.row(i);
  const float strong = this->lifting.threshold(data, i);
  InitialEntry* out = data.initial.open(static_cast<std::int64_t>(row.size()));
  std::int64_t size = 0;
  auto sum = static_cast<float>(std::max(0.0, data.fine.alpha(i)));
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
    out[e].weight /= sum;
  }
  data.initial.close(size);
}

void ExtendedInterpolation::gather(CoarseningData& data, std::int64_t i)
{
  const std::int64_t near = data.coarseNodes;
  CoarseningData::Slot* slots = data.slots.at(near);
  const std::uint32_t mark = data.freshMark();
  std::size_t size = 0;
  for (const RowEntry& entry : data.fine.row(i))
  {
    const std::int64_t j = i + entry.delta();
    const InitialEntry* initial = data.initial.row(j);
    const std::int64_t count = data.initial.size(j);
    this->Candidates.resize(
      std::max(this->Candidates.size(), size + static_cast<std::size_t>(count) + 1));
    Candidate* candidate = this->Candidates.data();
    for (const InitialEntry* end = initial + count; initial != end; ++initial)
    {
      const std::int32_t distance = offset(initial->coarse, near);
      candidate[size].distance = distance;
      size += slots[distance].add(mark, entry.weight() * initial->weight) ? 1 : 0;
    }
  }
  this->Candidates.resize(size);
  const auto inverse = static_cast<float>(1.0 / data.fine.diagonal(i));
  for (Candidate& candidate : this->Candidates)
  {
    candidate.weight = slots[candidate.distance].value * inverse;
  }
}

void ExtendedInterpolation::truncate(int entries)
{
  auto& list = this->Candidates;
  const auto most = static_cast<std::size_t>(entries);
  float sum = 0.0F;
  std::size_t kept = 0;
  for (const Candidate candidate : list)
  {
    sum += candidate.weight;
    if (kept == most && !(candidate.weight > list[kept - 1].weight))
    {
      continue;
    }
    // The largest so far are the first of the list, in descending order.
    std::size_t place = kept < most ? kept++ : kept - 1;
    for (; place > 0 && list[place - 1].weight < candidate.weight; --place)
    {
      list[place] = list[place - 1];
    }
    list[place] = candidate;
  }
  list.resize(kept);
  float keptSum = 0.0F;
  for (const Candidate& candidate : list)
  {
    keptSum += candidate.weight;
  }

  // Rounding to quanta, where negative weights become 0: the first entry, the largest, takes the
  // rest.
  const auto rounded = [](float quanta)
  { return std::clamp(static_cast<int>(quanta + 0.5F), 0, Quanta); };
  const float scale = keptSum > 0.0F ? sum / keptSum * Quanta : 0.0F;
  const int wanted = rounded(sum * Quanta);
  this->Rounded.resize(kept);
  int total = 0;
  for (std::size_t k = kept; k-- > 0;)
  {
    const int quanta = rounded(list[k].weight * scale);
    this->Rounded[k] = static_cast<std::uint32_t>(k > 0 ? quanta : std::max(0, wanted - total));
    total += quanta;
  }
}

void ExtendedInterpolation::operator()(CoarseningData& data, std::int64_t i)
{
  const CoarseIndex coarse = data.lifted[i];
  if (coarse != CoarseningData::Retained)
  {
    this->Candidates.assign(1, { offset(coarse, data.coarseNodes), 1.0F });
    this->Rounded.assign(1, Quanta);
  }
  else
  {
    this->gather(data, i);
    const bool finest = data.fine.childReach(i) < 0;
    this->truncate(finest ? this->finestEntries : this->entries);
  }
  this->append(data, i);
}

void ExtendedInterpolation::append(CoarseningData& data, std::int64_t i)
{
  const std::int64_t near = data.coarseNodes;
  InterpolationEntry* out =
    data.interpolation.open(static_cast<std::int64_t>(this->Candidates.size()));
  int size = 0;
  std::int64_t reach = -1;
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < this->Candidates.size(); ++k)
  {
    const std::uint32_t quanta = this->Rounded[k];
    if (quanta == 0)
    {
      continue;
    }
    const std::int64_t coarse = near + this->Candidates[k].distance;
    const ChildLink link(i, size);
    ChildLink& last = data.lastChild[coarse];
    (last.none() ? data.firstChild[coarse] : data.child(last, i).next) = link;
    last = link;
    out[size++] = InterpolationEntry(static_cast<CoarseIndex>(coarse), quanta);
    reach = std::max(reach, coarse);
    sum += quanta;
  }
  data.interpolation.close(size);
  data.rowQuanta[i] = static_cast<std::uint16_t>(sum);
  data.parentReach.append(reach);
}

} // namespace smg
