// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshCondition.h"

#include "Filters/Conditions/ConditionText.h"
#include "Filters/Conditions/vtkConditionList.h"
#include "Filters/Mesh/vtkNamedArray.h"
#include "Filters/Regions/vtkHeldPoints.h"
#include "smg/Error.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkMeshCondition);

namespace
{

/** Whether a type of the class is the kind of the same name: one is cast to the other. */
constexpr bool isKind(vtkMeshCondition::ConditionTypes type, smg::ConditionKind kind)
{
  return static_cast<int>(type) == static_cast<int>(kind);
}
static_assert(isKind(vtkMeshCondition::DIRICHLET, smg::ConditionKind::Dirichlet));
static_assert(isKind(vtkMeshCondition::FLUX, smg::ConditionKind::Flux));
static_assert(isKind(vtkMeshCondition::ROBIN, smg::ConditionKind::Robin));
static_assert(isKind(vtkMeshCondition::SOURCE, smg::ConditionKind::Source));
static_assert(isKind(vtkMeshCondition::CONDUCTIVITY, smg::ConditionKind::Conductivity));
static_assert(isKind(vtkMeshCondition::SCREENING, smg::ConditionKind::Screening));
static_assert(isKind(vtkMeshCondition::SOFT, smg::ConditionKind::Soft));

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
    condition.kind = static_cast<smg::ConditionKind>(this->Self.Condition);
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

vtkMeshCondition::~vtkMeshCondition()
{
  this->SetTagArray(nullptr);
}

void vtkMeshCondition::SetRegion(int region)
{
  const int clamped = std::clamp<int>(region, FUNCTION, EVERYWHERE);
  if (this->Region != clamped)
  {
    this->Region = clamped;
    this->Modified();
  }
}

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

void vtkMeshCondition::Check()
{
  if (this->Region == TAG &&
      (!this->TagArray || !*this->TagArray || std::string(this->TagArray) == "None"))
  {
    throw smg::Error("The condition has no tag array: choose TagArray, or another Region.");
  }
  this->Internal->condition().text();
}

void vtkMeshCondition::Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  smg::Condition condition = this->Internal->condition();
  if (this->Region == TAG)
  {
    condition.tagged = this->TagArray;
    condition.tag = this->Tag;
  }
  else if (this->Region != EVERYWHERE || !condition.mayHoldEverywhere())
  {
    condition.mask = smg::newMaskName(piece);
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName(condition.mask.c_str());
    mask->SetNumberOfTuples(piece.GetNumberOfPoints());
    mask->Fill(this->Region == EVERYWHERE ? 1.0 : 0.0);
    for (std::size_t i = 0; i < held.by.size(); ++i)
    {
      mask->SetValue(static_cast<vtkIdType>(i), held.by[i] >= 0 ? 1 : 0);
    }
    output.GetPointData()->AddArray(mask);
    // Views show the region of the condition.
    output.GetPointData()->SetActiveScalars(condition.mask.c_str());
  }
  smg::addCondition(output, condition.text());
}

void vtkMeshCondition::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TagArray: " << (this->TagArray ? this->TagArray : "(none)") << "\n";
  os << indent << "Tag: " << this->Tag << "\n";
  os << indent << "Condition: " << this->Condition << "\n";
  os << indent << "Value: " << this->Value << "\n";
  os << indent << "NumberOfValues: " << this->GetNumberOfValues() << "\n";
  os << indent << "ValueIsPosition: " << this->ValueIsPosition << "\n";
  os << indent << "Coefficient: " << this->Coefficient << "\n";
}
