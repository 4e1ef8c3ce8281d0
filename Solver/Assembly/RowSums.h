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
 * arithmetic the diagonal is positive, as in every cell. A sum smaller than the rounding of its
 * terms carries no information on the problem; with this amount added to the diagonal, and its
 * product with the initial value to the right-hand side, the vertex stays near its initial value.
 * `terms` is the sum of the magnitudes of all terms of the diagonal.
 */
inline double lostDiagonalOf(double diagonal, double terms)
{
  // More than the rounding of double precision: what is derived from the row has single precision.
  constexpr double Rounding = 1e-8;
  const double least = std::max<double>(Rounding * terms, FLT_MIN);
  return std::max(0.0, least - diagonal);
}

/** lostDiagonalOf() for the row whose diagonal is `rowSum` plus these weights. */
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
 * The square of the largest weight that counts as one of regular cells with conductivity 1, for an
 * edge between these points.
 *
 * A chain of slivers with weights w conducts like 1 / w, so that rounding them to single precision
 * may change the solution by 6e-8 w^2 of its range. With only smaller weights than these rounded,
 * it changed by at most 2e-7 (bunny_tet.mesh, dragon.ply), with all weights rounded by 2e-5.
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

} // namespace smg
