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

/** The cell type of a vtkPolyData or vtkUnstructuredGrid with cells. Throws Error, which begins
 * with `where`, unless they are all triangles or all tetrahedra. */
VTKSTREAMINGMULTIGRIDIO_EXPORT CellType cellTypeOf(vtkPointSet& piece, const std::string& where);

/** Whether the cells of such a mesh are all triangles or all tetrahedra. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool hasSimplices(vtkPointSet& piece);

/** The corners of all cells, as point indices. Throws Error if they are not of type `type`. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<std::int64_t> cellCorners(
  vtkPointSet& piece, CellType type, const std::string& where);

/** Removes duplicate cells from `corners`, which are those of all cells of the piece,
 * `cornersOfCell` each. Returns the indices of the remaining cells. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<std::int64_t> keepOwnCells(
  vtkPointSet& piece, int cornersOfCell, std::vector<std::int64_t>& corners);

/** The cells with the given corners, `cornersOfCell` each. */
VTKSTREAMINGMULTIGRIDIO_EXPORT vtkSmartPointer<vtkCellArray> makeCells(
  std::span<const std::int64_t> corners, int cornersOfCell);

/** Sets the cells, `cornersOfCell` corners each, of a vtkPolyData or a vtkUnstructuredGrid. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void setCells(
  vtkPointSet& mesh, std::span<const std::int64_t> corners, int cornersOfCell);

} // namespace smg
