// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/Sparsification.h"

#include <algorithm>
#include <bit>

// Galerkin products fill up: without sparsification the rows of a level grow with every level.
// Simply dropping small entries made V-cycles diverge on meshes of bad triangles. Here the weight w
// of an edge (c, k) moves to the path c - m - k through a common neighbour.
//
// The diagonal of a final row is its row sum plus its weights; rawDiagonal, from before
// sparsification, only serves to measure couplings. Moving or removing a weight therefore changes
// diagonals along with the weights, never a row sum: constants stay in the kernel where no
// constraint reaches.
//
// Only the upper entry of a pair, in row min(c, k), is read as its weight and modified; finishRow()
// copies it to the mirrored entry when no later row can change it any more. The entries of row k as
// it arrives, products before sparsification, only classify its edges as large or small.
//
// Cost: a scan of row k, and for each of its small lower edges (c, k) a scan of the large entries
// of row c, whose positions are kept in a bit mask.

namespace smg
{
namespace
{

/** The entry of the pair {c, k}, which must exist, in the upper one of its two rows. */
CoarseEntry& upperEntry(const CoarseningData& data, std::int64_t c, std::int64_t k)
{
  const std::int64_t row = std::min(c, k);
  const auto delta = static_cast<std::int32_t>(std::max(c, k) - row);
  CoarseEntry* first = data.raw.row(row) + data.rawLower[row];
  // A binary search without branches, which would be unpredictable. It always keeps the last entry
  // that is not beyond the wanted one.
  for (std::int64_t size = data.raw.size(row) - data.rawLower[row]; size > 1;)
  {
    const std::int64_t half = size / 2;
    first += first[half].offset(row) <= delta ? half : 0;
    size -= half;
  }
  return *first;
}

} // namespace

struct Sparsification::Candidate
{
  std::int64_t node = -1;
  float weight = 0.0F;
};

/** The common neighbour m of c and k > c, by edges of large weights, with the largest min(w_cm,
 * w_km), if that is above `least`. The large weights of row k are in the slots with the mark, 0
 * for its small ones. */
Sparsification::Candidate Sparsification::strongestCommon(
  const CoarseningData& data, std::int64_t c, std::uint32_t mark, float least) const
{
  Candidate best{ -1, least };
  const Slot* large = data.sparsifySlots.at(c);
  const CoarseEntry* row = data.raw.row(c);
  // Released neighbours of c are not neighbours of k, since all their neighbours precede k.
  const std::int64_t there = data.raw.first() - c;
  const auto consider = [&](const CoarseEntry& entry)
  {
    const std::int32_t delta = entry.offset(c);
    const float weight = std::min(entry.value(), large[delta].get(mark));
    // Strictly larger: of equal candidates the first in node order is taken.
    if (weight > best.weight && !entry.removed())
    {
      best = { c + delta, weight };
    }
  };
  // Entries that were large when row c came; the bits have ascending columns.
  for (std::uint64_t bits = data.rawLarge[c]; bits != 0; bits &= bits - 1)
  {
    const CoarseEntry& entry = row[std::countr_zero(bits)];
    if (entry.offset(c) >= there)
    {
      consider(entry);
    }
  }
  // Beyond the bits, which is rare, the entries are classified again.
  for (std::int64_t e = 64; e < data.raw.size(c); ++e)
  {
    const std::int32_t delta = row[e].offset(c);
    if (delta >= there && this->isLarge(row[e].value(), delta, data.rawStrongest.at(c)))
    {
      consider(row[e]);
    }
  }
  return best;
}

/** Marks row k, and each lower row to which it is coupled strongly, so that they keep all
 * entries: |w| > Coupled sqrt(a_cc a_kk), without the root. */
void Sparsification::keepStronglyCoupled(const CoarseningData& data, std::int64_t k) const
{
  constexpr double Strong = Coupled * Coupled;
  const CoarseEntry* row = data.raw.row(k);
  const float* diagonal = data.rawDiagonal.at(k);
  std::uint8_t* kept = data.rawKept.at(k);
  const double strong = Strong * static_cast<double>(*diagonal);
  for (std::int32_t e = 0; e < data.rawLower[k]; ++e)
  {
    const std::int32_t delta = row[e].offset(k);
    const double weight = row[e].value();
    if (weight * weight > strong * static_cast<double>(diagonal[delta]))
    {
      kept[0] = kept[delta] = 1;
    }
  }
}

void Sparsification::operator()(CoarseningData& data, std::int64_t k) const
{
  // First, since it may protect row k and rows below it from what follows.
  this->keepStronglyCoupled(data, k);
  const CoarseEntry* row = data.raw.row(k);
  const std::int32_t lower = data.rawLower[k];
  const std::int64_t size = data.raw.size(k);
  Slot* large = data.sparsifySlots.at(k);
  const std::uint32_t mark = data.sparsifySlots.freshMark();
  const StrongestWeight* strongest = data.rawStrongest.at(k);
  // mirrored[delta] is the position in row k + delta of its entry for row k.
  const std::int32_t* mirrored = data.rawMirrored.at(k);
  std::uint64_t bits = 0;
  for (std::int64_t e = 0; e < size; ++e)
  {
    const std::int32_t delta = row[e].offset(k);
    const float weight = row[e].value();
    const bool counts = this->isLarge(weight, delta, strongest);
    // Every neighbour of k gets the mark, small ones with 0: strongestCommon() sees these as no
    // connection.
    large[delta] = { mark, counts ? weight : 0.0F };
    bits |= std::uint64_t(counts && e < 64) << (e & 63);
    // This edge will probably be removed: its entry in the upper row is needed soon.
    if (!counts && e < lower)
    {
      __builtin_prefetch(data.raw.row(k + delta) + mirrored[delta]);
    }
  }
  data.rawLarge[k] = bits;
  const std::uint8_t* kept = data.rawKept.at(k);
  if (*kept != 0)
  {
    return;
  }
  for (std::int64_t e = 0; e < lower; ++e)
  {
    const std::int32_t delta = row[e].offset(k);
    // Large by the products alone: not a candidate.
    if (large[delta].value != 0.0F)
    {
      continue;
    }
    const std::int64_t c = k + delta;
    CoarseEntry& pair = data.raw.row(c)[mirrored[delta]];
    // Its present weight, to which earlier pairs may have moved theirs.
    const float weight = pair.value();
    if (kept[delta] != 0 || !this->isSmall(weight, strongest->weight(), strongest[delta].weight()))
    {
      continue;
    }
    // A negative weight needs edges above 2 |w|, so that these stay positive and clearly so.
    const Candidate middle = this->strongestCommon(data, c, mark, std::max(0.0F, -2.0F * weight));
    if (middle.node < 0 && weight != 0.0F && !(this->dropsNegative && weight < 0.0F))
    {
      continue;
    }
    // The edges c - m and m - k take the weight. Without m it is zero or may be dropped, and
    // nothing moves.
    for (const std::int64_t node : { c, k })
    {
      if (middle.node >= 0)
      {
        CoarseEntry& taker = upperEntry(data, node, middle.node);
        taker.setValue(taker.value() + weight);
      }
    }
    pair.remove();
  }
}

} // namespace smg
