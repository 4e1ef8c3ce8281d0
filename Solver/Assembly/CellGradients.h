// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "smg/MeshSource.h"

#include <cstddef>

namespace smg
{

/** The gradients of the hat functions at the corners of a cell; on a triangle, in its plane. */
class CellGradients
{
public:
  /** `points` are the corners of a cell that is not degenerate (see CellWeights::measure). */
  CellGradients(CellType type, const double* const* points);

  /** grad phi of corner k. */
  const Vector& operator[](int k) const { return this->Of[static_cast<std::size_t>(k)]; }

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
  std::array<Vector, 4> Of{};
};

} // namespace smg
