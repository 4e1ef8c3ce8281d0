// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/LevelRows.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <span>

namespace smg
{

/**
 * What the diagonal of a row of weights of both signs lacks. In exact arithmetic it is positive, as
 * every cell's is; where less is left of the sum than its terms' rounding, it is no part of the
 * problem, and a vertex with that much more on its diagonal stays near its initial value.
 */
inline double rowShortfall(std::span<const RowEntry> row, double alpha)
{
  constexpr double Rounding = 1e-6;
  double diagonal = alpha;
  double terms = std::fabs(alpha);
  for (const RowEntry& entry : row)
  {
    diagonal += entry.weight();
    terms += std::fabs(entry.weight());
  }
  const double least = std::max<double>(Rounding * terms, FLT_MIN);
  return std::max(0.0, least - diagonal);
}

} // namespace smg
