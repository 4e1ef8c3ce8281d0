// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/MeshSource.h"

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

/**
 * The floor of the cotangent weight of an edge, that keeps the operator an M-matrix on obtuse
 * meshes: about a thousandth of the weight in a regular mesh. Triangles: 5e-4, whatever the length;
 * tetrahedra: 1e-4 times the edge's length.
 */
double cotangentFloor(CellType type, const double* a, const double* b);

} // namespace smg
