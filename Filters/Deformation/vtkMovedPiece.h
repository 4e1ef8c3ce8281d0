// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointSet;

namespace smg
{

/** The active normals, else the array Normals if it has three components; nullptr: there are none.
 */
vtkDataArray* findNormals(vtkDataSetAttributes& arrays);

/** How a piece of a mesh is moved. */
struct PieceMotion
{
  /** Of each point the new position and, if `columns` is 6, the new normal. */
  const std::vector<double>& values;
  int columns = 3;
  /** Whether triangles that have normals get new ones; else, as in all other cases, the old ones
   * are taken away. */
  bool needsCellNormals = true;
};

/**
 * Makes `output` the piece with its points moved, in their precision, and with all its arrays but
 * active tangents and normals that are not true any more. Throws Error if a position does not fit
 * the precision.
 */
void movePiece(vtkPointSet& piece, const PieceMotion& motion, vtkPointSet& output);

} // namespace smg
