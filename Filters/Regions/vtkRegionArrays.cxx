// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkRegionArrays.h"

#include "Filters/Pieces/vtkReplacedArray.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <variant>

namespace smg
{
namespace
{

bool isRegion(vtkPointSet& mesh, const std::string& name)
{
  vtkStringArray* names = fieldTexts(mesh, MeshRegionsName);
  return names && names->LookupValue(name) >= 0;
}

} // namespace

void addToRegion(vtkPointSet& mesh, const std::string& name, const HeldPoints& held)
{
  vtkPointData& points = *mesh.GetPointData();
  vtkNew<vtkUnsignedCharArray> region;
  if (vtkAbstractArray* present = points.GetAbstractArray(name.c_str()))
  {
    if (!isRegion(mesh, name) || !vtkUnsignedCharArray::SafeDownCast(present))
    {
      throw Error("The input has a point array " + name +
                  ", which no Mesh Region has made: choose another RegionName.");
    }
    region->DeepCopy(present);
  }
  else
  {
    region->SetNumberOfTuples(mesh.GetNumberOfPoints());
    region->Fill(0.0);
  }
  region->SetName(name.c_str());
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    if (held.by[i] >= 0)
    {
      region->SetValue(static_cast<vtkIdType>(i), 1);
    }
  }
  points.AddArray(region);
  if (!isRegion(mesh, name))
  {
    appendFieldText(mesh, MeshRegionsName, name);
  }
}

std::vector<Where> placesOn(vtkPointSet& mesh, const char* text, const char* property)
{
  std::vector<Where> places;
  vtkStringArray* names = fieldTexts(mesh, MeshRegionsName);
  for (vtkIdType k = 0; names && k < names->GetNumberOfValues(); ++k)
  {
    // Filters between may have taken the array away.
    vtkDataArray* array = mesh.GetPointData()->GetArray(names->GetValue(k).c_str());
    if (array)
    {
      places.emplace_back(ColumnMask{ names->GetValue(k) });
    }
  }
  if (text && *text)
  {
    std::ranges::move(readPlacesText(text, property), std::back_inserter(places));
  }
  return places;
}

void dropEmptyRegions(vtkPointSet& preview, std::vector<Where>& places)
{
  std::erase_if(places,
    [&preview](const Where& place)
    {
      const auto* mask = std::get_if<ColumnMask>(&place);
      vtkDataArray* array = mask && isRegion(preview, mask->column)
                              ? preview.GetPointData()->GetArray(mask->column.c_str())
                              : nullptr;
      return array && array->GetRange()[1] == 0.0;
    });
}

} // namespace smg
