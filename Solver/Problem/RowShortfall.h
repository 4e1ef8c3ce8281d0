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
inline double rowShortfall(
  std::span<const RowEntry> row, double alpha, std::span<const double> precise)
{
  // Of numbers in double precision, too: what is built on the row has single precision.
  constexpr double Rounding = 1e-8;
  double terms = std::fabs(alpha);
  double diagonal = alpha;
  for (std::size_t e = 0; e < row.size(); ++e)
  {
    const double weight = precise.empty() ? static_cast<double>(row[e].weight()) : precise[e];
    diagonal += weight;
    terms += std::fabs(weight);
  }
  const double least = std::max<double>(Rounding * terms, FLT_MIN);
  return std::max(0.0, least - diagonal);
}

} // namespace smg
