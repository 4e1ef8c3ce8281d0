// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAbstractArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"

#include <array>
#include <cstddef>
#include <string>

namespace smg
{

/** Which point arrays are the normals, the scalars by which views colour, and the like. */
class ActiveAttributes
{
public:
  void take(vtkPointData& points)
  {
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      vtkAbstractArray* array = points.GetAbstractAttribute(type);
      this->Names[static_cast<std::size_t>(type)] =
        array && array->GetName() ? array->GetName() : "";
    }
  }

  void giveTo(vtkPointData& points) const
  {
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      const std::string& name = this->Names[static_cast<std::size_t>(type)];
      const bool isOfNumbers =
        type == vtkDataSetAttributes::GLOBALIDS || type == vtkDataSetAttributes::PEDIGREEIDS;
      if (!isOfNumbers && points.HasArray(name.c_str()))
      {
        points.SetActiveAttribute(name.c_str(), type);
      }
    }
  }

private:
  std::array<std::string, vtkDataSetAttributes::NUM_ATTRIBUTES> Names;
};

} // namespace smg
