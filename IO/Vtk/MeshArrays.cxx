// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/MeshArrays.h"

#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/GroupData.h"
#include "IO/Vtk/PieceColumns.h"
#include "smg/Error.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <string>
#include <utility>

namespace smg
{
namespace
{

/** The name of an array; of one without a name, that which the writers of VTK give it if it is an
 * active one, else empty. */
std::string nameOfArray(vtkDataSetAttributes& arrays, vtkAbstractArray& array)
{
  if (array.GetName())
  {
    return array.GetName();
  }
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    if (arrays.GetAbstractAttribute(type) == &array)
    {
      return std::string(vtkDataSetAttributes::GetAttributeTypeAsString(type)) + '_';
    }
  }
  return {};
}

/** The groups of a mesh. Throws Error if an array has a set that they do not have. */
MeshGroups groupsOf(vtkPointSet& mesh)
{
  MeshGroups groups = groupsIn(mesh);
  const std::pair<vtkDataSetAttributes*, const char*> columns[] = { { mesh.GetPointData(),
                                                                      VertexGroupsName },
    { mesh.GetCellData(), FacetGroupsName }, { mesh.GetCellData(), CellGroupsName } };
  for (const auto& [data, name] : columns)
  {
    vtkDataArray* const sets = data->GetArray(name);
    for (int k = 0; !groups.empty() && sets && k < sets->GetNumberOfComponents(); ++k)
    {
      double range[2];
      sets->GetRange(range, k);
      if (range[1] >= static_cast<double>(groups.sets.size()))
      {
        throw Error(std::string("The input has a set of groups in its array ") + name +
                    " that its field array " + MeshGroupsName +
                    " does not have: leave one of the two out.");
      }
    }
  }
  return groups;
}

} // namespace

VtkMeshArrays::VtkMeshArrays(vtkPointSet& mesh)
{
  this->Views.groups = groupsOf(mesh);
  if (vtkPoints* points = mesh.GetPoints())
  {
    this->Views.points = this->viewOf(*points->GetData());
  }
  if (auto* surface = vtkPolyData::SafeDownCast(&mesh))
  {
    this->addCells(surface->GetVerts(), VTK_POLY_VERTEX, nullptr);
    this->addCells(surface->GetLines(), VTK_POLY_LINE, nullptr);
    this->addCells(surface->GetPolys(), VTK_POLYGON, nullptr);
    this->addCells(surface->GetStrips(), VTK_TRIANGLE_STRIP, nullptr);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh))
  {
    this->addCells(grid->GetCells(), 0, grid->GetCellTypesArray());
  }
  this->addAttributes(*mesh.GetPointData(), mesh.GetNumberOfPoints(), this->Views.ofPoints);
  this->addAttributes(*mesh.GetCellData(), mesh.GetNumberOfCells(), this->Views.ofCells);
}

void VtkMeshArrays::addCells(vtkCellArray* cells, int type, vtkDataArray* types)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return;
  }
  CellArrays list{ this->viewOf(*cells->GetConnectivityArray()),
    this->viewOf(*cells->GetOffsetsArray()), {}, type };
  if (types)
  {
    list.types = this->viewOf(*types);
  }
  this->Views.cells.push_back(list);
}

void VtkMeshArrays::addAttributes(
  vtkDataSetAttributes& from, std::int64_t tuples, AttributeArrays& to)
{
  for (int k = 0; k < from.GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray& array = *from.GetAbstractArray(k);
    const std::string name = nameOfArray(from, array);
    const bool ofCells = &to == &this->Views.ofCells;
    const bool isContract = !ofCells && (name == GlobalIdsName || name == StreamFinalizedName);
    if (name.empty() || array.GetNumberOfTuples() != tuples || isContract)
    {
      continue;
    }
    auto* numbers = vtkDataArray::SafeDownCast(&array);
    if (!numbers || !scalarTypeOf(*numbers))
    {
      if (to.others.size() < MaxOtherArrays)
      {
        to.others.insert(name);
      }
    }
    else if (name != GhostTypeName)
    {
      to.arrays.push_back({ name, this->viewOf(*numbers) });
      to.normals = numbers == from.GetNormals() ? name : to.normals;
    }
    else if (ofCells && numbers->GetNumberOfComponents() == 1)
    {
      this->Views.ghosts = this->viewOf(*numbers);
    }
  }
}

ArrayView VtkMeshArrays::viewOf(vtkDataArray& array)
{
  vtkDataArray* numbers = &array;
  if (!array.HasStandardMemoryLayout())
  {
    this->Copies.push_back(
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(array.GetDataType())));
    numbers = this->Copies.back();
    numbers->DeepCopy(&array);
  }
  const ScalarType type = *scalarTypeOf(array);
  const auto size = static_cast<std::int64_t>(sizeOf(type));
  const std::int64_t columns = array.GetNumberOfComponents();
  return { .data = array.GetNumberOfTuples() > 0 ? numbers->GetVoidPointer(0) : nullptr,
    .type = type,
    .rows = array.GetNumberOfTuples(),
    .columns = columns,
    .rowStride = size * columns,
    .columnStride = size };
}

} // namespace smg
