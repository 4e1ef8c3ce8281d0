// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/vtkChosenArrays.h"

#include "Solver/Core/Error.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace smg
{

std::string ChosenArrays::any(int index) const
{
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  const char* chosen =
    info.Has(vtkDataObject::FIELD_NAME()) ? info.Get(vtkDataObject::FIELD_NAME()) : nullptr;
  const std::string name = chosen ? chosen : "";
  if (name.empty() || name == "None")
  {
    return {};
  }
  if (this->Input.GetPointData()->HasArray(name.c_str()) &&
      this->Input.GetCellData()->HasArray(name.c_str()))
  {
    throw Error("The points and the cells of the input both have an array " + name +
                ": rename one of them, so that it is clear which one is meant.");
  }
  return name;
}

std::string ChosenArrays::ofPoints(int index) const
{
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  std::string name = this->any(index);
  if (!name.empty() && info.Has(vtkDataObject::FIELD_ASSOCIATION()) &&
      info.Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    throw Error("The array " + name +
                " is chosen from the cells: a point array is needed; use a filter that turns cell "
                "data into point data.");
  }
  return name;
}

int ChosenArrays::components(const std::string& name, int otherwise) const
{
  vtkDataArray* array = this->Input.GetPointData()->GetArray(name.c_str());
  array = array ? array : this->Input.GetCellData()->GetArray(name.c_str());
  return array ? array->GetNumberOfComponents() : otherwise;
}

} // namespace smg
