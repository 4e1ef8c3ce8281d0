// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/MeshPieceData.h"

#include "IO/Mesh/Columns.h"
#include "IO/Vtk/FieldMarks.h"
#include "IO/Vtk/GroupData.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceColumns.h"

#include "vtkAbstractArray.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace smg
{
namespace
{

/** The field arrays of a preview. */
constexpr const char* PreviewMarks[] = { PreviewName, FullNumberOfPointsName, FullNumberOfCellsName,
  PreviewOfReaderName };

/** An array of type `Array` with the values, each converted by `convert`. */
template <class Array, class T, class Convert>
vtkSmartPointer<Array> arrayOf(
  const char* name, int components, const std::vector<T>& values, Convert convert)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::transform(values.begin(), values.end(), array->GetPointer(0), convert);
  return array;
}

vtkSmartPointer<vtkPoints> makePoints(const std::vector<double>& positions, bool isDouble)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  if (isDouble)
  {
    points->SetData(
      arrayOf<vtkDoubleArray>("Points", 3, positions, [](double value) { return value; }));
  }
  else
  {
    points->SetData(arrayOf<vtkFloatArray>(
      "Points", 3, positions, [](double value) { return static_cast<float>(value); }));
  }
  return points;
}

void addCount(vtkPointSet& mesh, const char* name, std::int64_t count)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->InsertNextValue(count);
  addFieldArray(mesh, *array);
}

std::int64_t countBehind(vtkPointSet& mesh, const char* name)
{
  vtkDataArray* count = mesh.GetFieldData()->GetArray(name);
  return isPreview(mesh) && count && count->GetNumberOfTuples() > 0 ? integersOf(*count).front()
                                                                    : 0;
}

} // namespace

void setPiece(vtkPointSet& mesh, const MeshPiece& piece, const StreamInfo& info)
{
  mesh.SetPoints(makePoints(piece.positions, info.doublePositions));
  setCells(mesh, piece.corners, cornersOf(info.cellType));
  vtkPointData& points = *mesh.GetPointData();
  points.SetGlobalIds(arrayOf<vtkIdTypeArray>(
    GlobalIdsName, 1, piece.ids, [](std::int64_t id) { return static_cast<vtkIdType>(id); }));
  points.AddArray(arrayOf<vtkUnsignedCharArray>(GhostTypeName, 1, piece.ghost,
    [](std::uint8_t isGhost) -> unsigned char
    { return isGhost ? vtkDataSetAttributes::DUPLICATEPOINT : 0; }));
  points.AddArray(arrayOf<vtkUnsignedCharArray>(
    StreamFinalizedName, 1, piece.finalized, [](std::uint8_t isFinal) { return isFinal; }));
  // ParaView does not offer these arrays as a mask or a source.
  for (const char* name : { GlobalIdsName, GhostTypeName, StreamFinalizedName })
  {
    hide(*points.GetArray(name));
  }
  for (const Column& column : piece.vertexColumns)
  {
    const int place = points.AddArray(makeArray(column));
    if (isActiveNormals(column.spec))
    {
      points.SetActiveAttribute(place, vtkDataSetAttributes::NORMALS);
    }
    else if (isActiveTexture(column.spec))
    {
      points.SetActiveAttribute(place, vtkDataSetAttributes::TCOORDS);
    }
  }
  if (!piece.normals.empty() && !points.HasArray(NormalsName))
  {
    points.SetNormals(
      arrayOf<vtkFloatArray>(NormalsName, 3, piece.normals, [](float number) { return number; }));
  }
  for (const Column& column : piece.cellColumns)
  {
    mesh.GetCellData()->AddArray(makeArray(column));
  }
  addGroups(mesh, info.groups);
  if (!piece.ghostCells.empty())
  {
    const auto ghosts = arrayOf<vtkUnsignedCharArray>(GhostTypeName, 1, piece.ghostCells,
      [](std::uint8_t isGhost) -> unsigned char
      { return isGhost ? vtkDataSetAttributes::DUPLICATECELL : 0; });
    hide(*ghosts);
    mesh.GetCellData()->AddArray(ghosts);
  }
  // Neither does it offer the flags of the conversion.
  if (vtkDataArray* flags = mesh.GetCellData()->GetArray(CellFlagsName))
  {
    hide(*flags);
  }
}

void removeFinalized(vtkPointSet& mesh)
{
  mesh.GetPointData()->RemoveArray(StreamFinalizedName);
}

void markAsPreview(vtkPointSet& mesh, const StreamInfo& full)
{
  vtkNew<vtkIntArray> mark;
  mark->SetName(PreviewName);
  mark->InsertNextValue(1);
  mark->InsertNextValue(cornersOf(full.cellType)); // filters turn surfaces into grids
  addFieldArray(mesh, *mark);
  addCount(mesh, FullNumberOfPointsName, full.vertices);
  addCount(mesh, FullNumberOfCellsName, full.cells);
}

void markAsReaders(vtkPointSet& preview)
{
  addMark(preview, PreviewOfReaderName, PreviewOfReaderComponents);
}

void removePreviewMarks(vtkPointSet& mesh)
{
  for (const char* name : PreviewMarks)
  {
    mesh.GetFieldData()->RemoveArray(name);
  }
}

void copyPreviewMarks(vtkDataObject& preview, vtkDataObject& made)
{
  for (const char* name : PreviewMarks)
  {
    if (vtkAbstractArray* mark = preview.GetFieldData()->GetAbstractArray(name))
    {
      made.GetFieldData()->AddArray(mark);
    }
  }
}

bool isPreview(vtkPointSet& mesh)
{
  vtkDataArray* mark = mesh.GetFieldData()->GetArray(PreviewName);
  return mark && mark->GetNumberOfTuples() > 0 && mark->GetComponent(0, 0) != 0.0;
}

std::int64_t pointsBehind(vtkPointSet& mesh)
{
  return countBehind(mesh, FullNumberOfPointsName);
}

std::int64_t cellsBehind(vtkPointSet& mesh)
{
  return countBehind(mesh, FullNumberOfCellsName);
}

bool isSurfaceOfSolid(vtkPointSet& mesh)
{
  if (!isPreview(mesh) || mesh.GetNumberOfCells() == 0)
  {
    return false;
  }
  vtkDataArray* mark = mesh.GetFieldData()->GetArray(PreviewName);
  const bool isOfSolid = mark->GetNumberOfTuples() > 1 && mark->GetComponent(1, 0) == 4.0;
  return isOfSolid && mesh.GetCell(0)->GetCellDimension() == 2;
}

} // namespace smg
