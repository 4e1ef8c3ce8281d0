// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/MeshArrays.h"
#include "IO/External/Workspace.h"
#include "IO/Import/RawMesh.h"
#include "smg/Error.h"

#include <string>

namespace smg
{

/** Throws ArgumentError unless points have three columns and cells three or four of integers. */
void checkArrays(const ArrayView& points, const ArrayView& cells);

/** The mesh of arrays: vertices and cells are their rows. Throws ArgumentError, which names the
 * row, if a coordinate is not finite or a corner is not a vertex, or there are no cells; Cancelled.
 */
RawMesh importArrays(const ArrayView& points, const ArrayView& cells, Workspace& workspace,
  const ProgressFunction& progress);

/** The mesh of arrays with cells of any type and attributes, as that of a file of VTK: cells that
 * are marked as ghosts are left out. Throws Error, which begins with the name of the mesh and names
 * the point or the cell, if a coordinate is not finite, a corner is not a vertex, a type is not
 * read, or there are no cells of the chosen kind; Cancelled. */
RawMesh importArrays(const MeshArrays& mesh, const std::string& name, CellChoice choice,
  Workspace& workspace, const ProgressFunction& progress);

} // namespace smg
