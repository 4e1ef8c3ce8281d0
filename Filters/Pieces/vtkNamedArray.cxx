// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/vtkNamedArray.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace smg
{

int componentsOf(vtkPointSet& mesh, const std::string& name, int otherwise)
{
  vtkDataArray* array = mesh.GetPointData()->GetArray(name.c_str());
  array = array ? array : mesh.GetCellData()->GetArray(name.c_str());
  return array ? array->GetNumberOfComponents() : otherwise;
}

} // namespace smg
