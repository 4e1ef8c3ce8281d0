// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "smg/MeshSource.h"

#include <cmath>
#include <cstdint>

namespace smg
{

/** A facet of exactly one cell with its conditions (see FacetBatch). */
struct BoundaryFacet
{
  static constexpr int cornersOf(CellType type) { return smg::cornersOf(type) - 1; }

  std::int64_t corners[3]; ///< stream indices, ascending; two for an edge
  std::int32_t flux = -1;  ///< index of its condition
  std::int32_t robin = -1;
  // In the order of the corners; null without a condition.
  const double* fluxValue = nullptr;   ///< `columns` per corner
  const double* coefficient = nullptr; ///< one per corner
  const double* ambient = nullptr;     ///< `columns` per corner
};

/** The length or area of a facet with these corners. */
inline double facetArea(CellType type, const double* const* points)
{
  const Vector ab = difference(points[1], points[0]);
  if (type == CellType::Triangle)
  {
    return std::sqrt(dot(ab, ab));
  }
  const Vector normal = cross(ab, difference(points[2], points[0]));
  return 0.5 * std::sqrt(dot(normal, normal));
}

} // namespace smg
