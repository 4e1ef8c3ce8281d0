// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/Interpolation.h"

#include "Solver/Multigrid/Setup/InterpolationRow.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace smg
{
void ExtendedInterpolation::initial(CoarseningData& data, std::int64_t i) const
{
  constexpr CoarseIndex FPoint = CoarseningData::FPoint;
  data.initialTotal.extendRaw(i + 1);
  const CoarseIndex* coarseIndex = data.coarseIndex.at(i);
  if (*coarseIndex != FPoint)
  {
    *data.initial.open(1) = { *coarseIndex, 1.0F };
    data.initial.close(1);
    data.initialTotal[i] = 1.0F;
    return;
  }
  const auto row = data.fine.row(i);
  const float strong = this->coarsePoints.threshold(data, i);
  CoarseEntry* out = data.initial.open(static_cast<std::int64_t>(row.size()));
  std::int64_t size = 0;
  const auto rowSum = static_cast<float>(std::max(0.0, data.fine.rowSum(i)));
  float sum = rowSum;
  for (const RowEntry& entry : row)
  {
    const CoarseIndex coarse = coarseIndex[entry.delta()];
    if (coarse != FPoint && entry.weight() >= strong)
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
             this->coarsePoints.isOfSlivers(data, i)
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
  const RelaxedRow& row = data.relaxed[i];
  int rounded[RelaxedRow::Most];
  int rest = quantaOf(row.sum);
  for (int k = 0; k < row.size; ++k)
  {
    rounded[k] = quantaOf(std::clamp(row.entry[k].value(), -1.0F, 1.0F));
    rest -= rounded[k];
  }
  // The first entry, the largest, receives the remainder as far as its range permits.
  for (int k = 0; k < row.size && rest != 0; ++k)
  {
    const int taken = std::clamp(rounded[k] + rest, -Quanta, Quanta) - rounded[k];
    rounded[k] += taken;
    rest -= taken;
  }
  InterpolationRow out(data, i, row.size);
  for (int k = 0; k < row.size; ++k)
  {
    if (rounded[k] != 0)
    {
      out.appendAt(row.entry[k].offset(data.seenCoarse), rounded[k]);
    }
  }
  out.close();
}

namespace
{

/** A patch whose matrix is this close to singular is relaxed node by node. */
constexpr double MinPivot = 1e-6;

/** Row i is solved for together with what its neighbours take from it while this share of its
 * diagonal remains: below it, the neighbours are so strongly coupled among themselves that each
 * would count for several. */
constexpr float MinShare = 0.3F;

/**
 * The current rows of P near row i, relaxed or the initial ones, as row i sees them: a retained
 * neighbour k with w_ik > 0 follows row i.
 *
 *   not relaxed yet: P_k = (Z_k P0_k + w_ik P_i) / (Z_k + w_ik)
 *   relaxed:         P_k + w_ik / A_kk (P_i - the current P_i), about the one it was relaxed with
 */
class NewestRows
{
public:
  struct Row
  {
    std::span<const CoarseEntry> entries;
    float sum;
  };
  /** What a neighbour is in the equation of row i. */
  struct Response
  {
    float weight;   ///< of its row
    float ofItself; ///< of P_i
    float ofOld;    ///< of - the current P_i
  };

  NewestRows(const CoarseningData& data, std::int64_t i)
    : Data(data)
    , I(i)
    , Initial(data.initial.near(i))
    , Total(data.initialTotal.at(i))
    , Coarse(data.coarseIndex.at(i))
    , Relaxed(data.relaxed.at(i))
    , RelaxedEnd(data.relaxed.end() - i)
  {
  }

  Row operator[](std::int32_t distance) const
  {
    if (this->isRelaxed(distance))
    {
      const RelaxedRow& row = this->Relaxed[distance];
      return { { row.entry, static_cast<std::size_t>(row.size) }, row.sum };
    }
    return { this->Initial[distance], this->Data.initialSum(this->I + distance) };
  }

  Response response(const RowEntry& entry) const
  {
    const std::int32_t distance = entry.delta();
    const float w = entry.weight();
    if (!(w > 0.0F) || this->Coarse[distance] != CoarseningData::FPoint)
    {
      return { w, 0.0F, 0.0F };
    }
    if (this->isRelaxed(distance))
    {
      // Where weights of row k are negative, its diagonal may be less than w.
      const float back = w * std::min(1.0F, w / this->Data.patches.diagonal(this->I + distance));
      return { w, back, back };
    }
    const float back = w * (w / (this->Total[distance] + w));
    return { w - back, back, 0.0F };
  }

private:
  bool isRelaxed(std::int32_t distance) const
  {
    return distance < this->RelaxedEnd && this->Relaxed[distance].size != RelaxedRow::Pending;
  }

  const CoarseningData& Data;
  std::int64_t I;
  RaggedRing<CoarseEntry>::Near Initial;
  const float* Total;
  const CoarseIndex* Coarse;
  const RelaxedRow* Relaxed;
  std::int64_t RelaxedEnd; // distance
};

/** The equation (A_ii - ofItself) P_i = what has been added; lacking = (A_ii - ofItself) (1 - the
 * sum of P_i). */
struct RowEquation
{
  float ofItself; ///< weight of P_i in the rows of the neighbours
  double lacking;
};

/** The equation of row i from its neighbours for which counts(entry) is true: add(distance of the
 * coarse node from seenCoarse, weight). */
template <class Counts, class Add>
RowEquation equationOf(const CoarseningData& data, std::int64_t i, Counts counts, Add add)
{
  const std::int64_t near = data.seenCoarse;
  const NewestRows newest(data, i);
  const float diagonal = data.patches.diagonal(i);
  float ofItself = 0.0F, ofOld = 0.0F;
  for (const RowEntry& entry : data.fine.row(i))
  {
    if (counts(entry))
    {
      const NewestRows::Response response = newest.response(entry);
      ofItself += response.ofItself;
      ofOld += response.ofOld;
    }
  }
  const bool follow = diagonal - ofItself > MinShare * diagonal;
  RowEquation equation{ follow ? ofItself : 0.0F, data.fine.rowSum(i) };
  const auto addRow = [&](const NewestRows::Row& row, float weight)
  {
    equation.lacking += static_cast<double>(weight) * (1.0F - row.sum);
    for (const CoarseEntry& p : row.entries)
    {
      add(p.offset(near), weight * p.value());
    }
  };
  for (const RowEntry& entry : data.fine.row(i))
  {
    if (counts(entry))
    {
      addRow(newest[entry.delta()], follow ? newest.response(entry).weight : entry.weight());
    }
  }
  if (follow && ofOld > 0.0F)
  {
    addRow(newest[0], -ofOld);
  }
  return equation;
}

} // namespace

void ExtendedInterpolation::relax(CoarseningData& data, std::int64_t i)
{
  if (data.coarseIndex[i] != CoarseningData::FPoint)
  {
    RelaxedRow& row = data.relaxed[i];
    row.sum = 1.0F;
    row.size = 1;
    row.entry[0] = { data.coarseIndex[i], 1.0F };
    return;
  }
  if (const Patch* patch = data.patches.of(i))
  {
    int fPoints[PatchMatrix::Most];
    int count = 0;
    for (int k = 0; k < patch->size; ++k)
    {
      if (data.coarseIndex[patch->member(k)] == CoarseningData::FPoint)
      {
        fPoints[count++] = k;
      }
    }
    if (count > 1)
    {
      if (patch->member(fPoints[count - 1]) == i)
      {
        this->relaxPatch(data, *patch, fPoints, count);
      }
      return;
    }
  }
  this->relaxNode(data, i);
}

/** The possible columns of row i, with weight 0, in the slots with the mark. */
void ExtendedInterpolation::openPattern(
  const CoarseningData& data, std::int64_t i, std::uint32_t mark)
{
  const std::int64_t near = data.seenCoarse;
  Slot* slots = data.slots.at(near);
  const auto initial = data.initial.near(i);
  std::size_t size = 0;
  for (const RowEntry& entry : data.fine.row(i))
  {
    const auto row = initial[entry.delta()];
    this->Row.resize(std::max(this->Row.size(), size + row.size() + 1));
    Candidate* candidate = this->Row.data();
    for (const CoarseEntry& p : row)
    {
      const std::int32_t distance = p.offset(near);
      candidate[size].distance = distance;
      size += slots[distance].mark == mark ? 0 : 1;
      slots[distance] = { mark, 0.0F };
    }
  }
  this->Row.resize(size);
}

/** The weights of the columns, times this factor. */
void ExtendedInterpolation::closePattern(const CoarseningData& data, float factor)
{
  const Slot* slots = data.slots.at(data.seenCoarse);
  for (Candidate& candidate : this->Row)
  {
    candidate.weight = factor * slots[candidate.distance].value;
  }
}

void ExtendedInterpolation::relaxNode(CoarseningData& data, std::int64_t i)
{
  Slot* slots = data.slots.at(data.seenCoarse);
  const std::uint32_t mark = data.slots.freshMark();
  this->openPattern(data, i, mark);
  const RowEquation equation = equationOf(
    data, i, [](const RowEntry&) { return true; },
    [slots, mark](std::int32_t distance, float value)
    {
      Slot& slot = slots[distance];
      if (slot.mark == mark)
      {
        slot.value += value;
      }
    });
  const float inverse = 1.0F / (data.patches.diagonal(i) - equation.ofItself);
  this->closePattern(data, inverse);
  this->store(data, i, 1.0 - equation.lacking * static_cast<double>(inverse));
}

void ExtendedInterpolation::gatherOutside(
  CoarseningData& data, std::int64_t i, const Patch& patch, std::uint32_t inside, Outside& sum)
{
  Slot* slots = data.slots.at(data.seenCoarse);
  const std::uint32_t mark = data.slots.freshMark();
  sum.weights.clear();
  const RowEquation equation = equationOf(
    data, i,
    [&](const RowEntry& entry)
    {
      bool outside = true;
      for (int k = 0; k < patch.size; ++k)
      {
        outside = outside && !((inside >> k & 1) != 0 && patch.member(k) == i + entry.delta());
      }
      return outside;
    },
    [&](std::int32_t distance, float value)
    {
      if (slots[distance].add(mark, value))
      {
        sum.weights.push_back({ distance, 0.0F });
      }
    });
  sum.lacking = equation.lacking;
  sum.ofItself = equation.ofItself;
  for (Candidate& candidate : sum.weights)
  {
    candidate.weight = slots[candidate.distance].value;
  }
}

/** Relaxes these F-points of a patch together. */
void ExtendedInterpolation::relaxPatch(
  CoarseningData& data, const Patch& patch, const int* members, int count)
{
  std::uint32_t inside = 0;
  for (int a = 0; a < count; ++a)
  {
    inside |= 1U << members[a];
  }
  PatchMatrix inverse = matrixOf(data.fine, patch).part(members, count);
  for (int a = 0; a < count; ++a)
  {
    Outside& sum = this->Of[static_cast<std::size_t>(a)];
    gatherOutside(data, patch.member(members[a]), patch, inside, sum);
    inverse.at(a, a) -= static_cast<double>(sum.ofItself);
  }
  if (!inverse.invert(MinPivot))
  {
    for (int a = 0; a < count; ++a)
    {
      this->relaxNode(data, patch.member(members[a]));
    }
    return;
  }
  Slot* slots = data.slots.at(data.seenCoarse);
  for (int a = 0; a < count; ++a)
  {
    const std::int64_t i = patch.member(members[a]);
    const std::uint32_t mark = data.slots.freshMark();
    this->openPattern(data, i, mark);
    double lacking = 0.0;
    for (int b = 0; b < count; ++b)
    {
      const Outside& sum = this->Of[static_cast<std::size_t>(b)];
      lacking += inverse.at(a, b) * sum.lacking;
      const auto factor = static_cast<float>(inverse.at(a, b));
      for (const Candidate& candidate : sum.weights)
      {
        Slot& slot = slots[candidate.distance];
        if (slot.mark == mark)
        {
          slot.value += factor * candidate.weight;
        }
      }
    }
    this->closePattern(data, 1.0F);
    this->store(data, i, 1.0 - lacking);
  }
}

} // namespace smg
