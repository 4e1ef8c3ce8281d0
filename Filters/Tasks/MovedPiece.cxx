// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/MovedPiece.h"

#include "Filters/Tasks/DeformedVertices.h"
#include "IO/Mesh/Columns.h"
#include "IO/Results/VertexNormals.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceColumns.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

namespace smg
{
namespace
{

vtkSmartPointer<vtkFloatArray> makeTriples(vtkIdType count)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(count);
  return array;
}

/** The moved points of the piece, in the precision of the old ones. */
vtkSmartPointer<vtkPoints> movedPoints(vtkPointSet& piece, const PieceMotion& motion)
{
  const vtkIdType count = piece.GetNumberOfPoints();
  auto points = vtkSmartPointer<vtkPoints>::New();
  // Points of no cell stay where they are.
  const auto moved = [&](vtkIdType i)
  {
    std::array<double, 3> to;
    std::copy_n(motion.values.begin() + i * motion.columns, 3, to.begin());
    if (std::isnan(to[0]))
    {
      piece.GetPoint(i, to.data());
    }
    return to;
  };
  if (piece.GetPoints()->GetDataType() == VTK_FLOAT)
  {
    vtkDataArray* array = piece.GetPointData()->GetGlobalIds();
    const std::vector<std::int64_t> ids = array ? integersOf(*array) : std::vector<std::int64_t>();
    const auto single = makeTriples(count);
    single->SetName("Points");
    for (vtkIdType i = 0; i < count; ++i)
    {
      const std::int64_t vertex = array ? ids[static_cast<std::size_t>(i)] : i;
      const std::array<double, 3> to = moved(i);
      single->SetTypedTuple(i, singlePrecision(to, vertex, "The moved mesh").data());
    }
    points->SetData(single);
    return points;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName("Points");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetTypedTuple(i, moved(i).data());
  }
  points->SetData(array);
  return points;
}

/** The normals stored with the positions. */
vtkSmartPointer<vtkFloatArray> normalsOfPoints(vtkIdType count, const PieceMotion& motion)
{
  const auto normals = makeTriples(count);
  for (vtkIdType i = 0; i < 3 * count; ++i)
  {
    const double normal = motion.values[i / 3 * motion.columns + 3 + i % 3];
    normals->SetValue(i, std::isnan(normal) ? 0.0F : static_cast<float>(normal));
  }
  return normals;
}

vtkSmartPointer<vtkFloatArray> normalsOfCells(vtkPointSet& mesh)
{
  const std::vector<std::int64_t> corners = cellCorners(mesh, CellType::Triangle, "The input");
  const auto normals = makeTriples(mesh.GetNumberOfCells());
  for (vtkIdType cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    std::array<std::array<double, 3>, 3> points;
    for (std::size_t k = 0; k < 3; ++k)
    {
      mesh.GetPoint(corners[3 * cell + k], points[k].data());
    }
    const TriangleShape shape = shapeOfTriangle(points[0], points[1], points[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      normals->SetTypedComponent(cell, axis, static_cast<float>(shape.normal[axis]));
    }
  }
  return normals;
}

/** Replaces all old normals by the new ones, or removes them. */
void replaceNormals(vtkDataSetAttributes& arrays, vtkFloatArray* normals)
{
  std::vector<std::string> names;
  const bool isFirstActive = arrays.GetNormals() != nullptr;
  while (vtkDataArray* old = findNormals(arrays))
  {
    names.push_back(old->GetName() ? old->GetName() : NormalsName);
    if (old == arrays.GetNormals())
    {
      arrays.SetNormals(nullptr);
    }
    arrays.RemoveArray(names.back().c_str());
  }
  for (std::size_t i = 0; i < names.size() && normals; ++i)
  {
    vtkNew<vtkFloatArray> copy;
    copy->ShallowCopy(normals);
    copy->SetName(names[i].c_str());
    const int place = arrays.AddArray(copy);
    if (i == 0 && isFirstActive)
    {
      arrays.SetActiveAttribute(place, vtkDataSetAttributes::NORMALS);
    }
  }
}

/** Active tangents refer to the undeformed surface and are not recomputed. */
void dropTangents(vtkDataSetAttributes& arrays)
{
  if (vtkDataArray* tangents = arrays.GetTangents())
  {
    const std::string name = tangents->GetName() ? tangents->GetName() : "";
    arrays.SetTangents(nullptr);
    arrays.RemoveArray(name.c_str());
  }
}

} // namespace

vtkDataArray* findNormals(vtkDataSetAttributes& arrays)
{
  vtkDataArray* normals = arrays.GetNormals();
  if (!normals)
  {
    normals = arrays.GetArray(NormalsName);
  }
  return normals && normals->GetNumberOfComponents() == 3 ? normals : nullptr;
}

void movePiece(vtkPointSet& piece, const PieceMotion& motion, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  if (piece.GetPoints())
  {
    output.SetPoints(movedPoints(piece, motion));
  }
  if (findNormals(*piece.GetPointData()))
  {
    replaceNormals(
      *output.GetPointData(), motion.columns == DeformedVertices::WithNormals
                                ? normalsOfPoints(piece.GetNumberOfPoints(), motion).Get()
                                : nullptr);
  }
  if (findNormals(*piece.GetCellData()))
  {
    const bool hasTriangles = output.IsA("vtkPolyData") && hasSimplices(output);
    replaceNormals(*output.GetCellData(),
      motion.needsCellNormals && hasTriangles ? normalsOfCells(output).Get() : nullptr);
  }
  dropTangents(*output.GetPointData());
  dropTangents(*output.GetCellData());
}

} // namespace smg
