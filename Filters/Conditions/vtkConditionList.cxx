// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Conditions/vtkConditionList.h"

#include "IO/Problem/ProblemFile.h"
#include "Solver/Description/ComposeDescriptions.h"

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

} // namespace

std::string conditionMaskName(int number)
{
  return "Condition" + std::to_string(number);
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
  for (int number = countConditions(mesh); number > 0; --number)
  {
    mesh.GetPointData()->RemoveArray(conditionMaskName(number).c_str());
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
    append(problem, readProblemText(conditionsOf(mesh)->GetValue(k),
                      "condition " + std::to_string(k + 1) + " of the input", defaults));
  }
}

} // namespace smg
