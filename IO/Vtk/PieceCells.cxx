// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceCells.h"

#include "smg/Error.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSetAttributes.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <numeric>

namespace smg
{
namespace
{

[[noreturn]] void refuse(const std::string& where)
{
  throw Error(
    where +
    " has cells that are neither all triangles nor all tetrahedra: triangulate it first, or, "
    "behind a filter that cuts the cells of a preview, raise Maximum Points In Memory of the "
    "reader, so that it shows the mesh as a whole.");
}

/** The cells of the piece; the caller checks their number of corners. */
vtkCellArray* cellsOf(vtkPointSet& piece, const std::string& where)
{
  if (auto* surface = vtkPolyData::SafeDownCast(&piece))
  {
    if (surface->GetNumberOfVerts() + surface->GetNumberOfLines() + surface->GetNumberOfStrips())
    {
      refuse(where);
    }
    return surface->GetPolys();
  }
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&piece))
  {
    return grid->GetCells();
  }
  throw Error(
    where + " is a " + piece.GetClassName() + ": a vtkPolyData or vtkUnstructuredGrid is needed.");
}

/** Tetrahedra and quadrilaterals have the same number of corners. */
bool areAllOf(vtkPointSet& piece, int vtkType)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&piece);
  if (!grid || grid->GetNumberOfCells() == 0)
  {
    return vtkType == VTK_TRIANGLE;
  }
  return grid->IsHomogeneous() && grid->GetCellType(0) == vtkType;
}

/** Copies the numbers if they are stored as an array of T; returns whether they are. */
template <class T>
bool copyPlain(vtkDataArray& numbers, std::vector<std::int64_t>& to)
{
  auto* plain = vtkAOSDataArrayTemplate<T>::FastDownCast(&numbers);
  if (plain)
  {
    std::copy_n(plain->GetPointer(0), to.size(), to.begin());
  }
  return plain != nullptr;
}

} // namespace

CellType cellTypeOf(vtkPointSet& piece, const std::string& where)
{
  if (piece.GetNumberOfCells() == 0)
  {
    throw Error(where + " has points, but no cells: triangulate it first.");
  }
  vtkCellArray* cells = cellsOf(piece, where);
  const vtkIdType corners = cells ? cells->IsHomogeneous() : 0;
  if (corners == 3 && areAllOf(piece, VTK_TRIANGLE))
  {
    return CellType::Triangle;
  }
  if (corners != 4 || !areAllOf(piece, VTK_TETRA))
  {
    refuse(where);
  }
  return CellType::Tetrahedron;
}

bool hasSimplices(vtkPointSet& piece)
{
  try
  {
    cellTypeOf(piece, "The input");
    return true;
  }
  catch (const Error&)
  {
    return false;
  }
}

std::vector<std::int64_t> cellCorners(vtkPointSet& piece, CellType type, const std::string& where)
{
  vtkCellArray* cells = cellsOf(piece, where);
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return {};
  }
  if (cellTypeOf(piece, where) != type)
  {
    throw Error(where + " has cells of another kind than the pieces before.");
  }
  std::vector<std::int64_t> corners(cells->GetNumberOfConnectivityIds());
  vtkDataArray& connectivity = *cells->GetConnectivityArray();
  if (!copyPlain<vtkTypeInt64>(connectivity, corners) &&
      !copyPlain<vtkTypeInt32>(connectivity, corners))
  {
    // Another array type, as in later VTK releases.
    const auto values = vtk::DataArrayValueRange<1>(&connectivity);
    std::transform(values.begin(), values.end(), corners.begin(),
      [](double id) { return static_cast<std::int64_t>(id); });
  }
  return corners;
}

std::vector<std::int64_t> keepOwnCells(
  vtkPointSet& piece, int cornersOfCell, std::vector<std::int64_t>& corners)
{
  std::vector<std::int64_t> kept(corners.size() / cornersOfCell);
  std::iota(kept.begin(), kept.end(), 0);
  if (vtkUnsignedCharArray* ghosts = piece.GetCellGhostArray())
  {
    // As in files: see isOwnVtkCell().
    constexpr int Others = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
                           vtkDataSetAttributes::HIDDENCELL;
    std::erase_if(
      kept, [ghosts](std::int64_t cell) { return (ghosts->GetValue(cell) & Others) != 0; });
    for (std::size_t k = 0; k < kept.size(); ++k)
    {
      std::copy_n(corners.begin() + kept[k] * cornersOfCell, cornersOfCell,
        corners.begin() + static_cast<std::int64_t>(k) * cornersOfCell);
    }
    corners.resize(kept.size() * cornersOfCell);
  }
  return kept;
}

vtkSmartPointer<vtkCellArray> makeCells(std::span<const std::int64_t> corners, int cornersOfCell)
{
  const auto cells = static_cast<vtkIdType>(corners.size()) / cornersOfCell;
  auto offsets = vtkSmartPointer<vtkTypeInt64Array>::New();
  offsets->SetNumberOfValues(cells + 1);
  for (vtkIdType cell = 0; cell <= cells; ++cell)
  {
    offsets->SetValue(cell, cell * cornersOfCell);
  }
  auto connectivity = vtkSmartPointer<vtkTypeInt64Array>::New();
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(corners.size()));
  std::copy(corners.begin(), corners.end(), connectivity->GetPointer(0));
  auto array = vtkSmartPointer<vtkCellArray>::New();
  array->SetData(offsets, connectivity);
  return array;
}

void setCells(vtkPointSet& mesh, std::span<const std::int64_t> corners, int cornersOfCell)
{
  const vtkSmartPointer<vtkCellArray> cells = makeCells(corners, cornersOfCell);
  if (auto* surface = vtkPolyData::SafeDownCast(&mesh))
  {
    surface->SetPolys(cells);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh))
  {
    grid->SetCells(cornersOfCell == 3 ? VTK_TRIANGLE : VTK_TETRA, cells);
  }
}

} // namespace smg
