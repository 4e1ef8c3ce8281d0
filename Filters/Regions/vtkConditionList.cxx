// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkConditionList.h"

#include "Filters/Pieces/vtkReplacedArray.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescriptionFiles.h"

#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

namespace smg
{
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
  return readProblemText(conditionsOf(mesh)->GetValue(k),
    "condition " + std::to_string(k + 1) + " of the input", defaults);
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

void applyConditions(vtkPointSet& mesh, ProblemDescription& problem)
{
  for (int k = 0; k < countConditions(mesh); ++k)
  {
    ProblemDescription defaults;
    defaults.weights = problem.weights;
    append(problem, conditionAt(mesh, k, defaults));
  }
}

} // namespace smg
