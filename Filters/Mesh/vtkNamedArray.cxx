// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesh/vtkNamedArray.h"

#include "Solver/Core/Error.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace smg
{

void requireOneArray(vtkPointSet& mesh, const std::string& name)
{
  if (mesh.GetPointData()->HasArray(name.c_str()) && mesh.GetCellData()->HasArray(name.c_str()))
  {
    throw Error("The points and the cells of the input both have an array " + name +
                ": rename one of them, so that it is clear which one is meant.");
  }
}

int componentsOf(vtkPointSet& mesh, const std::string& name, int otherwise)
{
  vtkDataArray* array = mesh.GetPointData()->GetArray(name.c_str());
  array = array ? array : mesh.GetCellData()->GetArray(name.c_str());
  return array ? array->GetNumberOfComponents() : otherwise;
}

} // namespace smg
