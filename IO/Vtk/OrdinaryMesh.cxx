// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/OrdinaryMesh.h"

#include "IO/Conversion/OpenArrays.h"
#include "IO/Formats/Vtk/VtkCell.h"
#include "IO/Vtk/MeshArrays.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{
namespace
{

/** Whether cells use no point before one that is not a duplicate and has a lower number. */
bool areUsedInOrder(vtkPointSet& mesh, const std::vector<std::int64_t>& ids, std::int64_t first)
{
  std::int64_t used = first;
  vtkNew<vtkIdList> corners;
  vtkUnsignedCharArray* ghosts = mesh.GetCellGhostArray();
  for (vtkIdType cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    if (ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0)
    {
      continue;
    }
    mesh.GetCellPoints(cell, corners);
    for (const vtkIdType corner : *corners)
    {
      const std::int64_t id = ids[static_cast<std::size_t>(corner)];
      if (id > used)
      {
        return false;
      }
      used = std::max(used, id + 1);
    }
  }
  return true;
}

/** Whether the points that are no duplicates have consecutive GlobalIds, in the order in which
 * cells use them first. */
bool isNumberedAsPiece(vtkPointSet& mesh, vtkDataArray& array)
{
  vtkUnsignedCharArray* ghosts = mesh.GetPointGhostArray();
  const std::vector<std::int64_t> ids = integersOf(array);
  std::vector<std::int64_t> own;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
  {
    if (!ghosts || (ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT) == 0)
    {
      own.push_back(ids[static_cast<std::size_t>(i)]);
    }
  }
  if (own.empty())
  {
    return true;
  }
  const std::int64_t first = *std::ranges::min_element(own);
  std::vector<bool> isSeen(own.size());
  for (const std::int64_t id : own)
  {
    // The difference of two numbers of 64 bits may not be one.
    const auto place = static_cast<std::size_t>(id) - static_cast<std::size_t>(first);
    if (place >= isSeen.size() || isSeen[place])
    {
      return false;
    }
    isSeen[place] = true;
  }
  return areUsedInOrder(mesh, ids, first);
}

} // namespace

bool hasSeveralProcesses()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

CellChoice countingCells(vtkPointSet& mesh)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh);
  for (vtkIdType cell = 0; grid && cell < grid->GetNumberOfCells(); ++cell)
  {
    if (isSolidOfVtk(grid->GetCellType(cell)))
    {
      return CellChoice::Tetrahedra;
    }
  }
  return CellChoice::Triangles;
}

bool lacksStreamNumbering(vtkDataObject& data)
{
  auto* mesh = vtkPointSet::SafeDownCast(&data);
  const bool isMesh = vtkPolyData::SafeDownCast(mesh) || vtkUnstructuredGrid::SafeDownCast(mesh);
  if (!isMesh || mesh->GetNumberOfCells() == 0)
  {
    return false;
  }
  vtkDataArray* ids = globalIdArray(*mesh);
  return !ids || (!isPreview(*mesh) && !hasSeveralProcesses() && !isNumberedAsPiece(*mesh, *ids));
}

StreamInfo ordinaryMeshInfo(vtkPointSet& mesh)
{
  StreamInfo info;
  const bool isSolid = countingCells(mesh) == CellChoice::Tetrahedra;
  info.cellType = isSolid ? CellType::Tetrahedron : CellType::Triangle;
  info.vertices = mesh.GetNumberOfPoints();
  if (auto* surface = vtkPolyData::SafeDownCast(&mesh))
  {
    for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
    {
      info.cells += cells->GetNumberOfConnectivityIds() - 2 * cells->GetNumberOfCells();
    }
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh);
  for (vtkIdType cell = 0; grid && cell < grid->GetNumberOfCells(); ++cell)
  {
    const int type = grid->GetCellType(cell);
    if (isSolidOfVtk(type) == isSolid)
    {
      info.cells += partsOfVtk(type, grid->GetCells()->GetCellSize(cell));
    }
  }
  info.vertexColumns = columnSpecs(*mesh.GetPointData());
  return info;
}

vtkSmartPointer<vtkPointSet> withoutOriginalNumbers(vtkPointSet& mesh)
{
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh.NewInstance());
  copy->ShallowCopy(&mesh);
  copy->GetPointData()->RemoveArray(OriginalIdName);
  copy->GetCellData()->RemoveArray(OriginalCellIdName);
  return copy;
}

namespace
{

/** Throws Error that names the type of a cell of which no parts are known. */
void requireKnownTypes(vtkPointSet& mesh)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh);
  for (vtkIdType cell = 0; grid && cell < grid->GetNumberOfCells(); ++cell)
  {
    const int type = grid->GetCellType(cell);
    if (type != VTK_EMPTY_CELL && !isReadFromVtk(type))
    {
      throw Error("The input has cells of the type " + nameOfVtkType(type) +
                  ", which are not cut into tetrahedra here: put Tetrahedralize before.");
    }
  }
}

} // namespace

ConversionReport writeOrdinaryMesh(
  vtkPointSet& mesh, const std::filesystem::path& path, const ConversionOptions& options)
{
  ConversionOptions given = options;
  given.cells = countingCells(mesh);
  if (ordinaryMeshInfo(mesh).cells <= 0)
  {
    requireKnownTypes(mesh);
    throw Error("The input has only points and lines, as a slice or a contour of a surface has: a "
                "mesh of triangles, other polygons or solid cells is needed.");
  }
  const VtkMeshArrays arrays(mesh);
  ConversionReport report = convertArrays(arrays.views(), "The input", path, given);
  if (report.dropped_cells > 0)
  {
    report.notes.push_back(std::to_string(report.dropped_cells) +
                           (given.cells == CellChoice::Tetrahedra
                               ? " points, lines and surface cells are left out, since "
                                 "the input has solid cells, too."
                               : " points and lines are left out."));
  }
  return report;
}

} // namespace smg
