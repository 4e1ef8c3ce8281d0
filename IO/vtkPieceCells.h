// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

class vtkCellArray;
class vtkPointSet;
template <class T>
class vtkSmartPointer;

namespace smg
{

/**
 * The kind of the cells of a vtkPolyData or vtkUnstructuredGrid that has some. Throws Error, which
 * begins with `where`, if they are anything but triangles, or tetrahedra.
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT CellType cellTypeOf(vtkPointSet& piece, const std::string& where);

/** The corners of all cells, as point numbers. Throws Error if they are not of the type `type`. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<std::int64_t> cellCorners(
  vtkPointSet& piece, CellType type, const std::string& where);

/**
 * Takes the cells that are marked as duplicates out of `corners`, which are those of all cells of
 * the piece, `cornersOfCell` each. Answers the numbers of the others.
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<std::int64_t> keepOwnCells(
  vtkPointSet& piece, int cornersOfCell, std::vector<std::int64_t>& corners);

/** The cells with the given corners, `cornersOfCell` each. */
vtkSmartPointer<vtkCellArray> makeCells(std::span<const std::int64_t> corners, int cornersOfCell);

/** Sets the cells, `cornersOfCell` corners each, of a vtkPolyData or a vtkUnstructuredGrid. */
void setCells(vtkPointSet& mesh, std::span<const std::int64_t> corners, int cornersOfCell);

} // namespace smg
