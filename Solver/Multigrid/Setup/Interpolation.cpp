// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/Interpolation.h"

#include "Solver/Multigrid/Setup/InterpolationRow.h"
#include "Solver/Multigrid/Setup/LinearRows.h"

#include <algorithm>
#include <cmath>
#include <span>

// The interpolation of the default operator set, in the first two of three steps: initial() makes
// P0, relax() improves it by Gauss-Seidel on the rows of P instead of on unknowns; appendRounded()
// in InterpolationRow.h rounds the rows and links their entries by column. Interpolation.h has the
// equations.
//
// The sum of each row of P is carried along by itself: row j sums to 1 minus its deficit, and the
// deficit is the row sum of A plus the weighted deficits of the neighbours, over what the responses
// leave of the diagonal. Where no constraint reaches all terms are zero, so that rows sum to
// exactly 1 whatever is dropped or rounded. P then reproduces constants, and the row sums of the
// Galerkin product are exactly zero.
//
// All decisions are made in stream order: candidates are listed in the order of the row's
// neighbours, and of equal magnitudes the first one is kept. Windows and threads therefore do not
// change a bit.
//
// Coarse nodes are given by their distances from data.publishedCoarse, the end of the coarse nodes
// that these stages know.

namespace smg
{
void ExtendedInterpolation::initial(CoarseningData& data, std::int64_t i) const
{
  constexpr CoarseIndex FPoint = CoarseningData::FPoint;
  data.initialTotal.extendRaw(i + 1);
  const CoarseIndex* coarseIndex = data.coarseIndex.at(i);
  // A C-point: injection.
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
  // Z_i contains the row sum: a prescribed neighbour pulls the node towards zero correction. A
  // negative row sum is left out, since Z_i might vanish.
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
  // A row with entries has a strong C-neighbour, so the sum is positive.
  for (std::int64_t e = 0; e < size; ++e)
  {
    out[e].setValue(out[e].value() / sum);
  }
  data.initial.close(size);
  data.initialTotal[i] = sum;
}

/** The maximum number of entries of row i of P. */
int ExtendedInterpolation::entriesOf(const CoarseningData& data, std::int64_t i) const
{
  const auto row = data.fine.row(i);
  const bool isNextToStiff = std::ranges::any_of(
    row, [&](const RowEntry& entry) { return data.fine.stiff(i + entry.delta()); });
  if (isNextToStiff)
  {
    return RelaxedRow::Most;
  }
  // childReach() is -1 on the finest level only.
  return this->entries == this->finestEntries || data.fine.childReach(i) >= 0 ||
             this->coarsePoints.cancels(data, i)
           ? this->entries
           : this->finestEntries;
}

/** Makes the relaxed row i of the columns in Row with the largest magnitudes, scaled to this
 * sum. */
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
    // Insertion into a list of at most five, in descending order; equal magnitudes stay in the
    // order in which they came.
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
  // What was dropped is distributed in proportion to the magnitudes, not to the weights: these may
  // cancel, and a factor for all of them would be unbounded.
  const auto wanted = static_cast<float>(sum);
  const float share = keptSize > 0.0F ? (wanted - keptSum) / keptSize : 0.0F;
  // A row of zeros has no direction to scale: it becomes empty, a node without correction.
  RelaxedRow& row = data.relaxed[i];
  row.size = keptSize > 0.0F ? static_cast<std::int8_t>(kept) : 0;
  row.sum = row.size > 0 ? wanted : 0.0F;
  for (int k = 0; k < row.size; ++k)
  {
    const Candidate& from = largest[k];
    row.entry[k] = { static_cast<CoarseIndex>(data.publishedCoarse + from.distance),
      from.weight + share * std::fabs(from.weight) };
  }
  if (this->linear && data.fine.isPlaced() && LinearRows::isFitted(data, i))
  {
    LinearRows::fit(data, i, row);
  }
}

namespace
{

/** A patch whose matrix is so close to singular that a pivot is below this share of its diagonal
 * entry is relaxed node by node. */
constexpr double MinPivot = 1e-6;

/** Row i is solved together with the response of its neighbours as long as more than this share
 * of its diagonal remains. Below it the neighbours are coupled so strongly among themselves
 * that each response would count several times. */
constexpr float MinShare = 0.3F;

/**
 * The current rows of P near row i, relaxed or initial ones, as row i sees them: an F-neighbour k
 * with w_ik > 0 responds to row i.
 *
 *   not relaxed yet: P_k = (Z_k P0_k + w_ik P_i) / (Z_k + w_ik)
 *   relaxed:         P_k + w_ik / A_kk (P_i - the current P_i)
 *
 * The current P_i is the one with which row k was relaxed.
 */
class NewestRows
{
public:
  struct Row
  {
    std::span<const CoarseEntry> entries;
    float sum;
  };
  /** What a neighbour contributes to the equation of row i: weights of its own row, of P_i, and
   * of minus the current P_i. */
  struct Response
  {
    float weight;
    float ofItself;
    float ofOld;
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
    // The row of a C-point is fixed. Neighbours with negative weights are left out, too: with them
    // some meshes took one V-cycle less, others one more.
    if (!(w > 0.0F) || this->Coarse[distance] != CoarseningData::FPoint)
    {
      return { w, 0.0F, 0.0F };
    }
    if (this->isRelaxed(distance))
    {
      // A row k with negative weights may have a diagonal below w: it does not respond by more than
      // P_i moves.
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
  std::int64_t RelaxedEnd; // as a distance from row i
};

/** The equation (A_ii - ofItself) P_i = what was added. The sum of P_i is 1 - lacking / (A_ii -
 * ofItself). */
struct RowEquation
{
  float ofItself; ///< weight of P_i in the responses of the neighbours
  double lacking;
};

/** Forms the equation of row i from its neighbours for which counts(entry) is true. It calls
 * add(distance of the coarse node from publishedCoarse, weight) for each term on the right-hand
 * side. */
template <class Counts, class Add>
RowEquation equationOf(const CoarseningData& data, std::int64_t i, Counts counts, Add add)
{
  const std::int64_t near = data.publishedCoarse;
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
  // Needs the responses of all neighbours: hence the loop above, before the rows are added.
  const bool follow = diagonal - ofItself > MinShare * diagonal;
  RowEquation equation{ follow ? ofItself : 0.0F, data.fine.rowSum(i) };
  const auto addRow = [&](const NewestRows::Row& row, float weight)
  {
    // Exactly zero where the row of the neighbour sums to 1.
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
  // Relaxed neighbours already contain a response to the current P_i, which the new one replaces.
  if (follow && ofOld > 0.0F)
  {
    addRow(newest[0], -ofOld);
  }
  return equation;
}

} // namespace

/** Row i in a sweep. The F-points of a patch are relaxed together when the sweep reaches the
 * last of them; until then the rows of the others stay as they were, Pending in the first
 * sweep. */
void ExtendedInterpolation::relax(CoarseningData& data, std::int64_t i)
{
  // Injection again, in the format of relaxed rows: others read it as a neighbour.
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
    // A patch with a single F-point is an ordinary row: its C-points are fixed.
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

/** Opens the pattern of row i: the columns that occur in P0 of a neighbour, each with weight 0
 * in the slot with the mark. What is added to other columns is dropped, so the pattern does not
 * grow from sweep to sweep. */
void ExtendedInterpolation::openPattern(
  const CoarseningData& data, std::int64_t i, std::uint32_t mark)
{
  const std::int64_t near = data.publishedCoarse;
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
      // Written in any case and kept if the column is new: no branch.
      size += slots[distance].mark == mark ? 0 : 1;
      slots[distance] = { mark, 0.0F };
    }
  }
  this->Row.resize(size);
}

/** Closes the pattern: copies the weights of the columns from their slots, times this factor. */
void ExtendedInterpolation::closePattern(const CoarseningData& data, float factor)
{
  const Slot* slots = data.slots.at(data.publishedCoarse);
  for (Candidate& candidate : this->Row)
  {
    candidate.weight = factor * slots[candidate.distance].value;
  }
}

/** Solves the equation of row i alone. */
void ExtendedInterpolation::relaxNode(CoarseningData& data, std::int64_t i)
{
  Slot* slots = data.slots.at(data.publishedCoarse);
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

/** Sums up what the neighbours of node i outside the relaxed part of its patch contribute.
 * `inside` has a bit for each member of the patch that is relaxed with it. Here all columns are
 * collected: each row that the inverse makes of them applies its own pattern. */
void ExtendedInterpolation::gatherOutside(
  CoarseningData& data, std::int64_t i, const Patch& patch, std::uint32_t inside, Outside& sum)
{
  Slot* slots = data.slots.at(data.publishedCoarse);
  const std::uint32_t mark = data.slots.freshMark();
  sum.weights.clear();
  const RowEquation equation = equationOf(
    data, i,
    [&](const RowEntry& entry)
    {
      // Without a branch: patches are small.
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

/** Relaxes the F-points of a patch together, which `members` lists by their numbers in the
 * patch: P_b = (A_bb - ofItself)^-1 times the sum over the neighbours outside. The C-points of
 * the patch count as outside. */
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
    // The neighbours respond to the row of this member: its diagonal shrinks.
    inverse.at(a, a) -= static_cast<double>(sum.ofItself);
  }
  // The responses may make the matrix singular or indefinite: fall back to the rows one by one.
  if (!inverse.invert(MinPivot))
  {
    for (int a = 0; a < count; ++a)
    {
      this->relaxNode(data, patch.member(members[a]));
    }
    return;
  }
  Slot* slots = data.slots.at(data.publishedCoarse);
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
