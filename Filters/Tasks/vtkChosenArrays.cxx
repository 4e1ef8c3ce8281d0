// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkChosenArrays.h"

#include "smg/Error.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace smg
{

std::string ChosenArrays::named(int index) const
{
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  const char* chosen =
    info.Has(vtkDataObject::FIELD_NAME()) ? info.Get(vtkDataObject::FIELD_NAME()) : nullptr;
  const std::string name = chosen ? chosen : "";
  return name == "None" ? "" : name;
}

std::string ChosenArrays::any(int index) const
{
  const std::string name = this->named(index);
  if (!name.empty() && this->Input.GetPointData()->HasArray(name.c_str()) &&
      this->Input.GetCellData()->HasArray(name.c_str()))
  {
    throw Error("The points and the cells of the input both have an array " + name +
                ": rename one of them, so that it is clear which one is meant. (In pvpython a name "
                "alone means the points, for which ParaView makes an array out of that of the "
                "cells: say [\"CELLS\", \"" +
                name + "\"].)");
  }
  return name;
}

std::string ChosenArrays::ofPoints(int index) const
{
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  const std::string name = this->named(index);
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
