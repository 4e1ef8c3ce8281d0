// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/PatchReference.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace smg::testing
{

/** A level to coarsen with its properties. */
struct CoarseningCase
{
  std::string name;
  TestLevel level;
  RecordingOperators operators;
  bool free;     ///< without constraints
  bool positive; ///< without negative weights

  /** The least weight of a strong edge of row i. */
  float strong(std::int64_t i) const
  {
    float terms = 0.0F;
    for (const RowEntry& entry : this->level.rows[i])
    {
      terms += std::fabs(entry.weight());
    }
    const bool cancels =
      terms > IndependentSetCoarsening().cancelling * static_cast<float>(this->level.diagonal(i));
    const float share = cancels ? this->operators.cancellingStrength : this->operators.strength;
    return std::max(share * this->level.strongest(i), FLT_MIN);
  }
};

/** Regular and irregular surfaces and tetrahedra, with and without constraints, of all weights. */
inline std::vector<CoarseningCase> coarseningCases()
{
  RecordingOperators surface, solid;
  surface.sweeps = 1;
  surface.cancelling = 1.1;
  surface.cancellingStrength = 0.5F;
  solid.strength = solid.cancellingStrength = 0.0F;
  solid.finestEntries = solid.entries = 5;
  solid.dropsNegative = true;
  const auto uniform = Weights::Uniform;
  const auto clamped = Weights::Clamped;
  const StreamMesh patch = toStream(shuffled(grid(24, 19, 0.3)));
  const StreamMesh ring = toStream(shuffled(torus(40, 16, 0.4)), TestOrder::Keep);
  const StreamMesh box = toStream(shuffled(tetBox(8, 7, 9, 0.15)));
  std::vector<CoarseningCase> cases = {
    { "grid, uniform", finestLevel(patch, uniform), surface, true, true },
    { "grid, constrained", finestLevel(patch, clamped, 9), surface, false, true },
    { "torus, clamped", finestLevel(ring, clamped), surface, true, true },
    { "torus, constrained", finestLevel(ring, uniform, 40), surface, false, true },
    { "box, clamped", finestLevel(box, clamped), solid, true, true },
    { "box, constrained", finestLevel(box, clamped, 13), solid, false, true },
  };
  const std::vector<TestLevel> levels = levelsWithPatches();
  solid.strength = solid.cancellingStrength = 0.05F;
  surface.sweeps = 2;
  cases.push_back({ "flat tetrahedra, constrained", levels[0], solid, false, false });
  cases.push_back({ "flat tetrahedra", levels[1], solid, true, false });
  cases.push_back({ "chains of slivers", levels[2], surface, false, false });
  cases.push_back({ "rows that lie close", levels[3], surface, false, true });
  return cases;
}

inline bool sameLevels(const TestLevel& a, const TestLevel& b)
{
  bool same = a.nodes() == b.nodes() && a.rowSum == b.rowSum;
  for (std::int64_t i = 0; same && i < a.nodes(); ++i)
  {
    same = std::equal(a.rows[i].begin(), a.rows[i].end(), b.rows[i].begin(), b.rows[i].end(),
      [](const RowEntry& x, const RowEntry& y)
      { return std::memcmp(&x, &y, sizeof(RowEntry)) == 0; });
  }
  return same;
}

} // namespace smg::testing
