// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Hierarchy/Sparsification.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg
{
namespace
{

constexpr float Removed = std::numeric_limits<float>::quiet_NaN();
/** Instead of the largest weight of a row that has not come yet: the other row's counts. */
constexpr float NotKnown = std::numeric_limits<float>::infinity();

/** The entry of the pair {c,k}, which is there, in the upper one of its two rows. */
RowEntry& upperEntry(const CoarseningData& data, std::int64_t c, std::int64_t k)
{
  const std::int64_t row = std::min(c, k);
  const auto delta = static_cast<std::int32_t>(std::max(c, k) - row);
  RowEntry* first = data.raw.row(row) + data.rawLower[row];
  // A binary search without branches, which nothing could predict.
  for (std::int64_t size = data.raw.size(row) - data.rawLower[row]; size > 1;)
  {
    const std::int64_t half = size / 2;
    first += first[half].delta <= delta ? half : 0;
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

/**
 * The common neighbour m of c and k > c with the largest min(w_cm, w_km) of large weights, those of
 * row k being in largeWeight.
 */
Sparsification::Candidate Sparsification::strongestCommon(
  const CoarseningData& data, std::int64_t c, std::int64_t k) const
{
  Candidate best;
  const float* large = data.largeWeight.at(c);
  const float* strongest = data.rawStrongest.at(c);
  const RowEntry* other = data.raw.row(c);
  const RowEntry* end = other + data.raw.size(c);
  for (; other != end; ++other)
  {
    const float weight = std::min(other->weight, large[other->delta]);
    // The first test is all that most entries get.
    if (weight > best.weight)
    {
      const std::int64_t m = c + other->delta;
      if (!this->isSmall(other->weight, *strongest, m > k ? NotKnown : strongest[other->delta]))
      {
        best = { m, weight };
      }
    }
  }
  return best;
}

void Sparsification::operator()(CoarseningData& data, std::int64_t k) const
{
  RowEntry* row = data.raw.row(k);
  RowEntry* upper = row + data.rawLower[k];
  RowEntry* end = row + data.raw.size(k);
  float* large = data.largeWeight.at(k);
  const float* strongest = data.rawStrongest.at(k);
  for (const RowEntry* entry = row; entry != upper; ++entry)
  {
    const std::int64_t c = k + entry->delta;
    __builtin_prefetch(data.raw.row(c) + data.rawMirrored[c]);
    const bool small = this->isSmall(entry->weight, *strongest, strongest[entry->delta]);
    large[entry->delta] = small ? 0.0F : entry->weight;
  }
  for (const RowEntry* entry = upper; entry != end; ++entry)
  {
    large[entry->delta] = this->isSmall(entry->weight, *strongest, NotKnown) ? 0.0F : entry->weight;
  }
  for (RowEntry* entry = row; entry != upper; ++entry)
  {
    const std::int64_t c = k + entry->delta;
    float& weight = data.raw.row(c)[data.rawMirrored[c]].weight;
    if (!this->isSmall(weight, *strongest, strongest[entry->delta]))
    {
      continue;
    }
    if (weight > 0.0F)
    {
      const Candidate middle = this->strongestCommon(data, c, k);
      if (middle.node < 0)
      {
        continue;
      }
      upperEntry(data, c, middle.node).weight += weight;
      upperEntry(data, k, middle.node).weight += weight;
    }
    weight = entry->weight = Removed;
    large[entry->delta] = 0.0F;
  }
  for (const RowEntry* entry = row; entry != end; ++entry)
  {
    large[entry->delta] = 0.0F;
  }
}

} // namespace smg
