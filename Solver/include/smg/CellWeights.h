// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

namespace smg
{

/** Measure and stiffness weights of a cell. */
struct CellWeights
{
  /** Area or volume, in the unit of the coordinates to the power of 2 or 3. 0: the cell is
   * degenerate, that is, flat up to rounding, and has no weight. */
  double measure = 0.0;
  /** Weights of the edges in the order of edgeCorners(): 3 of a triangle, 6 of a tetrahedron. */
  double weight[6] = {};
};

/** The corners (0 to 2) of each edge of a triangle, in the order of CellWeights::weight. */
inline constexpr int TriangleEdges[3][2] = { { 0, 1 }, { 0, 2 }, { 1, 2 } };
/** The corners (0 to 3) of each edge of a tetrahedron, in the order of CellWeights::weight. */
inline constexpr int TetrahedronEdges[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 },
  { 2, 3 } };

/** Number of edges of a cell: 3 of a triangle, 6 of a tetrahedron. */
constexpr int edgesOf(CellType type)
{
  return type == CellType::Triangle ? 3 : 6;
}
/** The two corners of edge `e` of a cell; `e` is from 0 to edgesOf(type) - 1. */
constexpr const int* edgeCorners(CellType type, int e)
{
  return type == CellType::Triangle ? TriangleEdges[e] : TetrahedronEdges[e];
}

/**
 * The cotangent weights of the triangle a, b, c: half the cotangent of the angle opposite to each
 * edge (Pinkall and Polthier 1993). They have no unit, and are 0 for a degenerate triangle.
 * Each corner is x, y, z.
 */
SMG_EXPORT CellWeights triangleWeights(const double* a, const double* b, const double* c);

/**
 * The stiffness of linear finite elements on the tetrahedron a, b, c, d, off-diagonal entries with
 * the sign changed: a sixth of the length of the opposite edge times the cotangent of the dihedral
 * angle there. Weights have the unit of length, and are 0 for a degenerate tetrahedron. Each corner
 * is x, y, z; their orientation does not matter.
 */
SMG_EXPORT CellWeights tetrahedronWeights(
  const double* a, const double* b, const double* c, const double* d);

/** triangleWeights() or tetrahedronWeights(); `points` has cornersOf(type) pointers to x, y, z. */
inline CellWeights cellWeights(CellType type, const double* const* points)
{
  return type == CellType::Triangle
           ? triangleWeights(points[0], points[1], points[2])
           : tetrahedronWeights(points[0], points[1], points[2], points[3]);
}

/**
 * The weights of a cell with a conductivity: weight_ij = -measure * grad phi_i . K grad phi_j, phi
 * being the linear basis functions. On a triangle the gradients lie in its plane.
 * @param type the kind of cell
 * @param points cornersOf(type) pointers to x, y, z
 * @param K six numbers, the symmetric tensor xx, yy, zz, xy, yz, xz. It is not checked: see
 * isPositiveDefinite().
 * @return as cellWeights(), times the unit of K
 */
SMG_EXPORT CellWeights conductivityWeights(
  CellType type, const double* const* points, const double* K);

/** Whether the six numbers of K (xx, yy, zz, xy, yz, xz) are finite and the tensor is positive
 * definite. */
SMG_EXPORT bool isPositiveDefinite(const double* K);

} // namespace smg
