// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshCondition.h"

#include "Filters/Regions/ConditionText.h"
#include "Filters/Regions/HeldPoints.h"
#include "Filters/Regions/RegionArrays.h"
#include "IO/Vtk/ModeProperty.h"
#include "IO/Vtk/PropertyRange.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkMeshCondition);

namespace
{

/** The data of the table smg::ProblemData that the ConditionTypes set, in their order. */
constexpr std::array Keys{ "dirichlet", "flux", "robin", "source", "conductivity", "screening",
  "soft" };
static_assert(Keys.size() == vtkMeshCondition::SOFT + 1);

/** Adds the array of the region of the condition, which views show; returns its name. */
std::string showRegion(vtkPointSet& output, const smg::HeldPoints& held)
{
  std::string name = smg::addMask(output);
  vtkDataArray& mask = *output.GetPointData()->GetArray(name.c_str());
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    mask.SetTuple1(static_cast<vtkIdType>(i), held.by[i] >= 0 ? 1 : 0);
  }
  output.GetPointData()->SetActiveScalars(name.c_str());
  return name;
}

} // namespace

struct vtkMeshCondition::Internals
{
  explicit Internals(vtkMeshCondition& self)
    : Self(self)
  {
  }

  /** The condition without its region. */
  smg::Condition condition() const
  {
    smg::Condition condition;
    condition.key = Keys[static_cast<std::size_t>(this->Self.Condition)];
    condition.values =
      this->Values.empty() ? std::vector<double>{ this->Self.Value } : this->Values;
    condition.isPosition = this->Self.ValueIsPosition;
    condition.coefficient = this->Self.Coefficient;
    return condition;
  }

  vtkMeshCondition& Self;
  std::vector<double> Values;
};

vtkMeshCondition::vtkMeshCondition()
  : Internal(new Internals(*this))
{
}

vtkMeshCondition::~vtkMeshCondition() = default;

void vtkMeshCondition::AddValue(double value)
{
  this->Internal->Values.push_back(value);
  this->Modified();
}

void vtkMeshCondition::RemoveAllValues()
{
  this->Internal->Values.clear();
  this->Modified();
}

int vtkMeshCondition::GetNumberOfValues()
{
  return static_cast<int>(this->Internal->Values.size());
}

bool vtkMeshCondition::IsEvaluatedBySolver()
{
  return this->Region == BOUNDARY || this->Region == MASK || this->Region == TAG ||
         this->Region == GROUP ||
         (this->Region == EVERYWHERE && this->Internal->condition().mayHoldEverywhere());
}

void vtkMeshCondition::Check()
{
  smg::requireInRange({ { "Condition", this->Condition, DIRICHLET, SOFT } });
  constexpr double NoLimit = smg::RealPropertyRange::NoLimit;
  const bool isNotNegative = this->Condition == SCREENING;
  const auto require = [&](const char* name, double value) {
    smg::requireInRealRange({ { name, value, isNotNegative ? 0.0 : -NoLimit } });
  };
  for (const double value : this->Internal->Values)
  {
    require("Values", value);
  }
  if (this->Internal->Values.empty() && !this->ValueIsPosition)
  {
    require("Value", this->Value);
  }
  if (this->Condition == ROBIN || this->Condition == SOFT)
  {
    smg::requireInRealRange({ { "Coefficient", this->Coefficient, 0.0 } });
  }
  if (this->Region == MASK || this->Region == TAG)
  {
    this->RegionArray();
  }
  if (this->Region == GROUP)
  {
    this->RegionGroup();
  }
  this->Internal->condition().text();
}

std::string vtkMeshCondition::UnusedProperty()
{
  const bool hasValues = !this->Internal->Values.empty();
  const std::string own = smg::unusedProperty({
    { "Value", this->Value != 0.0, !hasValues, "remove the Values" },
    { "Coefficient", this->Coefficient != 1.0, this->Condition != DIRICHLET,
      "set Condition to Robin or Soft" },
  });
  return own.empty() ? this->Superclass::UnusedProperty() : own;
}

void vtkMeshCondition::Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  smg::Condition condition = this->Internal->condition();
  if (this->Region == TAG)
  {
    condition.tagged = this->RegionArray();
    condition.tag = this->GetTag();
  }
  else if (this->Region == MASK)
  {
    condition.mask = this->RegionArray();
  }
  else if (this->Region == GROUP)
  {
    condition.group = this->RegionGroup();
    if (!held.by.empty())
    {
      showRegion(output, held);
    }
  }
  else if (this->Region == BOUNDARY)
  {
    condition.isOnBoundary = true;
  }
  else if (!this->IsEvaluatedBySolver())
  {
    condition.mask = showRegion(output, held);
  }
  smg::addCondition(output, condition.text());
}

void vtkMeshCondition::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Condition: " << this->Condition << "\n";
  os << indent << "Value: " << this->Value << "\n";
  os << indent << "NumberOfValues: " << this->GetNumberOfValues() << "\n";
  os << indent << "ValueIsPosition: " << this->ValueIsPosition << "\n";
  os << indent << "Coefficient: " << this->Coefficient << "\n";
}
