// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace smg
{

/** The gradients of the hat functions at the corners of a cell; on a triangle, in its plane. */
class CellGradients
{
public:
  /** `points` are the corners of a cell that is not degenerate (see CellWeights::measure). */
  CellGradients(CellType type, const double* const* points);

  /** grad phi of corner k. */
  const Vector& operator[](int k) const { return this->Gradients[static_cast<std::size_t>(k)]; }

  /** The gradient of the linear function with value[k][column] at corner k. */
  Vector of(CellType type, const double* const* value, int column) const
  {
    Vector sum{};
    for (int k = 1; k < cornersOf(type); ++k)
    {
      // Differences keep the gradient of a large and nearly constant function.
      const double step = value[k][column] - value[0][column];
      for (std::size_t d = 0; d < 3; ++d)
      {
        sum[d] += step * (*this)[k][d];
      }
    }
    return sum;
  }

private:
  std::array<Vector, 4> Gradients{};
};

/** Whether two corners of a cell of several vertices lie at the same place, up to rounding. */
SMG_EXPORT bool hasCoincidentCorners(const double* const* corners, int count);

/**
 * Weights that are not clamped cancel in the sums of a row. If a cell is so flat that the rounding
 * of its weights to single precision would be as large as the weights of other cells, all of its
 * weights are scaled down by one factor, which keeps its stiffness positive semidefinite. Returns
 * this factor for a cell with these finite-element weights for K = 1. It reduces them to at most
 * 1e5 (tetrahedra: times the longest edge), is 1 for nearly all cells, and depends neither on the
 * unit of length nor on that of a conductivity.
 *
 * Needles, triangles with one short edge and no angle near 180 degrees, have no large negative
 * weight that could cancel, and large weights are kept in double precision: they may have 1e7:
 * beyond, a mesh of them alone has no digit left. For caps a higher limit would be exact, too. But
 * where they lie flat on the edges of others, as in polygons with collinear corners, the number of
 * V-cycles grows with it: one such surface took 13 with 1e5, 51 with 1e6, 170 with 1e7.
 */
SMG_EXPORT double flatnessFactor(
  CellType type, const double* const* corners, const CellWeights& cell);

/**
 * The floor of the cotangent weight of an edge, which keeps the operator an M-matrix on obtuse
 * meshes: about a thousandth of the weight in a regular mesh. Triangles: 5e-4 for any length;
 * tetrahedra: 1e-4 times the length of the edge.
 */
double cotangentFloor(CellType type, const double* a, const double* b);

} // namespace smg
