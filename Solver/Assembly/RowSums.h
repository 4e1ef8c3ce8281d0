// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

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
inline double lostDiagonalOf(double diagonal, double terms)
{
  // Also for double precision: the data derived from the row have single precision.
  constexpr double Rounding = 1e-8;
  const double least = std::max<double>(Rounding * terms, FLT_MIN);
  return std::max(0.0, least - diagonal);
}

/** That of a row with entries of these weights, and `rowSum` added to its diagonal. */
inline double lostDiagonal(std::span<const double> weights, double rowSum)
{
  double terms = std::fabs(rowSum);
  double diagonal = rowSum;
  for (const double weight : weights)
  {
    diagonal += weight;
    terms += std::fabs(weight);
  }
  return lostDiagonalOf(diagonal, terms);
}

/**
 * The square of the largest weight of an edge of regular cells with the conductivity 1, of which
 * the ends have these coordinates.
 *
 * A chain of slivers with weights w conducts like 1 / w, so the rounding of its weights to single
 * precision may change the solution by 6e-8 w^2 of its range. Smaller weights than these changed it
 * by at most 2e-7 (bunny_tet.mesh, dragon.ply), all weights by 2e-5.
 */
inline double squaredRegularWeight(CellType type, const double* from, const double* to)
{
  constexpr double OfTriangles = 3.0, OfTetrahedra = 4.0; // of an edge of length 1
  if (type == CellType::Triangle)
  {
    return OfTriangles * OfTriangles;
  }
  const double d[3] = { from[0] - to[0], from[1] - to[1], from[2] - to[2] };
  return OfTetrahedra * OfTetrahedra * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/**
 * The factor of a row in the norm of the initial residual, by which all others are measured. Where
 * `own`, the contribution of screening, Robin and soft conditions to the diagonal, and what the
 * weights of slivers have beyond those of regular cells, is larger than the magnitudes of the
 * ordinary weights of the `edges`, the initial residual is as large as `own`, whatever that of all
 * other rows is; the row then counts as if it had only ordinary edges. In (0, 1]; 0 without edges.
 */
inline double commonShare(double own, double edges)
{
  return own > edges ? edges / own : 1.0;
}

} // namespace smg
