// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/vtkChosenArrays.h"

#include "Filters/Mesh/vtkNamedArray.h"
#include "Solver/Core/Error.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
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
  requireOneArray(this->Input, name);
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

} // namespace smg
