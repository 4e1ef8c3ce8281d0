// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/CellWeights.h"

#include <algorithm>
#include <cstdint>

namespace smg
{

/** Whether a cell uses a vertex twice. */
inline bool hasRepeatedCorner(const std::int64_t* corners, int count)
{
  for (int a = 1; a < count; ++a)
  {
    if (std::find(corners, corners + a, corners[a]) != corners + a)
    {
      return true;
    }
  }
  return false;
}

/**
 * Weights that are not clamped cancel in the sums of a row. Where a cell is so flat that their
 * rounding to single precision would be of the size of other cells' weights, all of its weights are
 * scaled down alike: its stiffness stays positive semidefinite. Answers the factor for a cell with
 * these finite-element weights for K = 1, which brings them to 1e5 at most (tetrahedra: times the
 * longest edge); 1 for nearly all cells. So it does not depend on the unit of length, nor on that
 * of a conductivity.
 */
double flatnessFactor(CellType type, const double* const* corners, const CellWeights& cell);

/**
 * The floor of the cotangent weight of an edge, that keeps the operator an M-matrix on obtuse
 * meshes: about a thousandth of the weight in a regular mesh. Triangles: 5e-4, whatever the length;
 * tetrahedra: 1e-4 times the edge's length.
 */
double cotangentFloor(CellType type, const double* a, const double* b);

} // namespace smg
