// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <array>

namespace smg::testing
{

/**
 * The contribution of a cell to the system: a weight for each pair of its corners, and its size.
 */
struct CellWeights
{
  double size = 0.0; ///< area or volume; 0: the cell has no weight
  /** Of the pairs 01, 02, 03, 12, 13, 23 of a tetrahedron; 01, 02, 12 of a triangle. */
  std::array<double, 6> weight{};
};

/** The pairs of corners in the order of CellWeights::weight. */
inline constexpr int TrianglePairs[3][2] = { { 0, 1 }, { 0, 2 }, { 1, 2 } };
inline constexpr int TetrahedronPairs[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 },
  { 2, 3 } };

/** Unclamped cotangent or stiffness weights of a cell with the given points (3 or 4 of them). */
CellWeights cellWeights(CellType type, const std::array<const double*, 4>& points);

} // namespace smg::testing
