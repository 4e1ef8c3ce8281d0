// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <span>

namespace smg
{

/**
 * The amount by which the diagonal of a row with weights of both signs is too small. In exact
 * arithmetic the diagonal is positive, like that of every cell. If the sum is smaller than the
 * rounding of its terms, it carries no information on the problem, and a vertex with this amount
 * added to its diagonal stays near its initial value.
 * `terms` is the sum of the magnitudes of what the diagonal sums up.
 */
inline double diagonalShortfall(double diagonal, double terms)
{
  // Also for double precision: the data derived from the row have single precision.
  constexpr double Rounding = 1e-8;
  const double least = std::max<double>(Rounding * terms, FLT_MIN);
  return std::max(0.0, least - diagonal);
}

/** That of a row with entries of these weights, and `alpha` added to its diagonal. */
inline double rowShortfall(std::span<const double> weights, double alpha)
{
  double terms = std::fabs(alpha);
  double diagonal = alpha;
  for (const double weight : weights)
  {
    diagonal += weight;
    terms += std::fabs(weight);
  }
  return diagonalShortfall(diagonal, terms);
}

} // namespace smg
