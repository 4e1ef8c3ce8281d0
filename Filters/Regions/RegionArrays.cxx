// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/RegionArrays.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkCellData.h"
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

bool addToRegion(vtkPointSet& mesh, const std::string& name, const HeldPoints& held)
{
  vtkPointData& points = *mesh.GetPointData();
  vtkNew<vtkUnsignedCharArray> region;
  vtkAbstractArray* present = points.GetAbstractArray(name.c_str());
  auto* mask = vtkUnsignedCharArray::SafeDownCast(present);
  if (present && (!mask || mask->GetNumberOfComponents() != 1))
  {
    throw Error("The input has a point array " + name +
                ", which is not that of a Mesh Region before this one: choose another RegionName, "
                "or take the array away with Pass Arrays.");
  }
  const bool isOfRegion = isRegion(mesh, name);
  if (present && isOfRegion)
  {
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
  addResult(points, *region);
  if (!isOfRegion)
  {
    appendFieldText(mesh, MeshRegionsName, name);
  }
  return present && !isOfRegion;
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

namespace
{

vtkStringArray* conditionsOf(vtkPointSet& mesh)
{
  return fieldTexts(mesh, MeshConditionsName);
}

/** An unused name for the point array of another condition. */
std::string newMaskName(vtkPointSet& mesh)
{
  for (int number = countConditions(mesh) + 1;; ++number)
  {
    const std::string name = "Condition" + std::to_string(number);
    if (!mesh.GetPointData()->HasArray(name.c_str()) && !mesh.GetCellData()->HasArray(name.c_str()))
    {
      return name;
    }
  }
}

ProblemDescription conditionAt(vtkPointSet& mesh, int k, const ProblemDescription& defaults)
{
  try
  {
    return readProblemText(conditionsOf(mesh)->GetValue(k), "problem", defaults);
  }
  catch (const Error& error)
  {
    throw Error(ConditionNames::ofAlone(k + 1).in(error.what()));
  }
}

} // namespace

std::string addMask(vtkPointSet& mesh)
{
  const std::string name = newMaskName(mesh);
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName(name.c_str());
  mask->SetNumberOfTuples(mesh.GetNumberOfPoints());
  mask->Fill(0.0);
  mesh.GetPointData()->AddArray(mask);
  appendFieldText(mesh, MeshConditionArraysName, name);
  return name;
}

void addCondition(vtkPointSet& mesh, const std::string& text)
{
  appendFieldText(mesh, MeshConditionsName, text);
}

bool isOfCondition(vtkPointSet& mesh, const std::string& array)
{
  vtkStringArray* masks = fieldTexts(mesh, MeshConditionArraysName);
  return masks && masks->LookupValue(array) >= 0;
}

void removeConditions(vtkPointSet& mesh)
{
  vtkStringArray* masks = fieldTexts(mesh, MeshConditionArraysName);
  for (vtkIdType k = 0; masks && k < masks->GetNumberOfValues(); ++k)
  {
    mesh.GetPointData()->RemoveArray(masks->GetValue(k).c_str());
  }
  mesh.GetFieldData()->RemoveArray(MeshConditionArraysName);
  mesh.GetFieldData()->RemoveArray(MeshConditionsName);
}

int countConditions(vtkPointSet& mesh)
{
  vtkStringArray* conditions = conditionsOf(mesh);
  return conditions ? static_cast<int>(conditions->GetNumberOfValues()) : 0;
}

ConditionNames applyConditions(vtkPointSet& mesh, ProblemDescription& problem)
{
  ConditionNames names;
  for (int k = 0; k < countConditions(mesh); ++k)
  {
    ProblemDescription defaults;
    defaults.weights = problem.weights;
    const ProblemDescription before = problem;
    append(problem, conditionAt(mesh, k, defaults));
    names.add(k + 1, before, problem);
  }
  return names;
}

} // namespace smg
