// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Conditions/vtkConditionList.h"

#include "Solver/Description/ComposeDescriptions.h"
#include "smg/DescriptionFiles.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

namespace smg
{
namespace
{

vtkStringArray* conditionsOf(vtkPointSet& mesh)
{
  return vtkStringArray::SafeDownCast(mesh.GetFieldData()->GetAbstractArray(MeshConditionsName));
}

ProblemDescription conditionAt(vtkPointSet& mesh, int k, const ProblemDescription& defaults)
{
  return readProblemText(conditionsOf(mesh)->GetValue(k),
    "condition " + std::to_string(k + 1) + " of the input", defaults);
}

} // namespace

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

void addCondition(vtkPointSet& mesh, const std::string& text)
{
  vtkNew<vtkStringArray> conditions;
  if (vtkStringArray* before = conditionsOf(mesh))
  {
    conditions->DeepCopy(before);
  }
  conditions->SetName(MeshConditionsName);
  conditions->InsertNextValue(text);
  mesh.GetFieldData()->AddArray(conditions);
}

void removeConditions(vtkPointSet& mesh)
{
  for (int k = 0; k < countConditions(mesh); ++k)
  {
    for (const std::string& mask : namedMasks(conditionAt(mesh, k, {})))
    {
      mesh.GetPointData()->RemoveArray(mask.c_str());
    }
  }
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
