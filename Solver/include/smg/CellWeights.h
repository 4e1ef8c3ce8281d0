// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

namespace smg
{

/** Measure and stiffness weights of a cell. */
struct CellWeights
{
  /** Area or volume; 0: the cell is degenerate, flat up to rounding, and has no weight. */
  double measure = 0.0;
  /** Weight of the edges (0,1), (0,2), (1,2) of a triangle or (0,1), (0,2), (0,3), (1,2), (1,3),
   * (2,3) of a tetrahedron. */
  double weight[6] = {};
};

/** Corners of the edges in the order of CellWeights::weight; a triangle has the first three of its
 * own list. */
inline constexpr int TriangleEdges[3][2] = { { 0, 1 }, { 0, 2 }, { 1, 2 } };
inline constexpr int TetrahedronEdges[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 },
  { 2, 3 } };

constexpr int edgesOf(CellType type)
{
  return type == CellType::Triangle ? 3 : 6;
}
/** The corners of edge e of a cell. */
constexpr const int* edgeCorners(CellType type, int e)
{
  return type == CellType::Triangle ? TriangleEdges[e] : TetrahedronEdges[e];
}

/**
 * The cotangent weights of a triangle, half the cotangent of the angle opposite to the edge
 * (Pinkall and Polthier 1993).
 */
SMG_EXPORT CellWeights triangleWeights(const double* a, const double* b, const double* c);

/**
 * The stiffness of linear finite elements on a tetrahedron, off-diagonals negated: a sixth of the
 * length of the opposite edge times the cotangent of the dihedral angle there.
 */
SMG_EXPORT CellWeights tetrahedronWeights(
  const double* a, const double* b, const double* c, const double* d);

/** Either of them: of a cell with the given corners. */
inline CellWeights cellWeights(CellType type, const double* const* points)
{
  return type == CellType::Triangle
           ? triangleWeights(points[0], points[1], points[2])
           : tetrahedronWeights(points[0], points[1], points[2], points[3]);
}

/**
 * The same with a conductivity, a symmetric tensor K = [xx, yy, zz, xy, yz, xz]: weight_ij =
 * -measure * grad phi_i . K grad phi_j. On a triangle the gradients lie in its plane.
 */
SMG_EXPORT CellWeights conductivityWeights(
  CellType type, const double* const* points, const double* K);

/** Whether all six numbers of K are finite and the tensor is positive definite. */
SMG_EXPORT bool isPositiveDefinite(const double* K);

} // namespace smg
