// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointSet;

namespace smg
{

/** The active normals, else the array Normals if it has three components, else nullptr. */
vtkDataArray* findNormals(vtkDataSetAttributes& arrays);

/** How a piece of a mesh is moved. */
struct PieceMotion
{
  /** The new position of each point and, if `columns` is 6, its new normal. */
  const std::vector<double>& values;
  int columns = 3;
  /** Whether triangles with normals get new ones; in all other cases the old ones are removed. */
  bool needsCellNormals = true;
};

/**
 * Sets `output` to the piece with its points moved, in their precision, and with all its arrays
 * except active tangents and outdated normals. Throws Error if a position exceeds the range of the
 * precision.
 */
void movePiece(vtkPointSet& piece, const PieceMotion& motion, vtkPointSet& output);

} // namespace smg
