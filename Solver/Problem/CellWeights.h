// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/MeshSource.h"

#include <algorithm>
#include <cstdint>

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
CellWeights triangleWeights(const double* a, const double* b, const double* c);

/**
 * The stiffness of linear finite elements on a tetrahedron, off-diagonals negated: a sixth of the
 * length of the opposite edge times the cotangent of the dihedral angle there.
 */
CellWeights tetrahedronWeights(const double* a, const double* b, const double* c, const double* d);

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
CellWeights conductivityWeights(CellType type, const double* const* points, const double* K);

/** Whether all six numbers of K are finite and the tensor is positive definite. */
bool isPositiveDefinite(const double* K);

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
