// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshHandle.h"

#include "Filters/Regions/HandleArrays.h"
#include "IO/Vtk/ModeProperty.h"
#include "IO/Vtk/PropertyRange.h"
#include "smg/DeformationDescription.h"
#include "smg/Error.h"

#include "vtkLinearTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkMeshHandle);
vtkCxxSetObjectMacro(vtkMeshHandle, Transform, vtkLinearTransform);

struct vtkMeshHandle::Internals
{
  explicit Internals(vtkMeshHandle& self)
    : Self(self)
  {
  }

  smg::HandleMotion motion() const
  {
    switch (this->Self.Motion)
    {
      case SIMILARITY:
      {
        smg::HandleMotion::Parameters parameters;
        std::copy_n(this->Self.Translation, 3, parameters.translation.begin());
        std::copy_n(this->Self.RotationAxis, 3, parameters.axis.begin());
        parameters.degrees = this->Self.RotationAngle;
        std::copy_n(this->Self.Center, 3, parameters.center.begin());
        parameters.scale = this->Self.Scale;
        return smg::HandleMotion(parameters);
      }
      case TRANSFORM:
        if (!this->Self.Transform)
        {
          throw smg::Error("The handle has no transform: set Transform, or choose another Motion.");
        }
        this->Self.Transform->Update();
        return smg::HandleMotion::fromMatrix(
          std::span<const double, 16>(this->Self.Transform->GetMatrix()->GetData(), 16));
      default:
        return {};
    }
  }

  /** Throws Error, which names the property, if a number of the motion is out of its range. */
  void checkMotion() const
  {
    constexpr double LeastScale = 1e-20, MostScale = 1e20, MostDegrees = 1e6;
    smg::requireInRealRange({ { "Scale", this->Self.Scale, LeastScale, MostScale },
      { "RotationAngle", this->Self.RotationAngle, -MostDegrees, MostDegrees } });
    for (int k = 0; k < 3; ++k)
    {
      smg::requireInRealRange({ { "Translation", this->Self.Translation[k] },
        { "RotationAxis", this->Self.RotationAxis[k] }, { "Center", this->Self.Center[k] } });
    }
    if (std::ranges::all_of(this->Self.RotationAxis, [](double x) { return x == 0.0; }))
    {
      throw smg::Error("RotationAxis is 0 0 0, which has no direction: set one of its numbers.");
    }
  }

  void checkTargets() const
  {
    for (std::size_t i = 0; this->isOfPoints() && i < this->Targets.size(); ++i)
    {
      smg::requireInRealRange({ { "PointTargets", this->Targets[i] } });
    }
  }

  /** Whether the region consists of single points. */
  bool isOfPoints() const
  {
    return this->Self.Region == SELECTION || this->Self.Region == IDS ||
           this->Self.Region == POINTS;
  }

  smg::HandleTargets targets() const
  {
    smg::HandleTargets targets{ this->motion(), {} };
    if (this->isOfPoints())
    {
      targets.ofHolders = this->Targets;
    }
    targets.check();
    return targets;
  }

  vtkMeshHandle& Self;
  std::vector<double> Targets;
};

vtkMeshHandle::vtkMeshHandle()
  : Internal(new Internals(*this))
{
}

vtkMeshHandle::~vtkMeshHandle()
{
  this->SetTransform(nullptr);
}

void vtkMeshHandle::AddPointTarget(double x, double y, double z)
{
  this->Internal->Targets.insert(this->Internal->Targets.end(), { x, y, z });
  this->Modified();
}

void vtkMeshHandle::RemoveAllPointTargets()
{
  this->Internal->Targets.clear();
  this->Modified();
}

vtkIdType vtkMeshHandle::GetNumberOfPointTargets()
{
  return static_cast<vtkIdType>(this->Internal->Targets.size() / 3);
}

vtkMTimeType vtkMeshHandle::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Transform ? std::max(time, this->Transform->GetMTime()) : time;
}

void vtkMeshHandle::Check()
{
  smg::requireInRange({ { "Motion", this->Motion, FIXED, TRANSFORM } });
  if (this->Motion == SIMILARITY)
  {
    this->Internal->checkMotion();
  }
  this->Internal->checkTargets();
  this->Internal->targets();
}

std::string vtkMeshHandle::UnusedProperty()
{
  // Panels hide what another chosen motion does not use, and keep it.
  const bool isChosen = this->Motion != FIXED;
  const bool isTranslated =
    std::ranges::any_of(this->Translation, [](double component) { return component != 0.0; });
  const bool hasTargets = !this->Internal->Targets.empty();
  const char* remedy = "set Motion to Similarity";
  const std::string own = smg::unusedProperty({
    { "Translation", isTranslated, isChosen, remedy },
    { "RotationAngle", this->RotationAngle != 0.0, isChosen, remedy },
    { "Scale", this->Scale != 1.0, isChosen, remedy },
    { "PointTargets", hasTargets, this->Internal->isOfPoints(),
      "set Region to Selection, Ids or Points" },
    { "Translation", isTranslated, !hasTargets, "remove the PointTargets" },
  });
  return own.empty() ? this->Superclass::UnusedProperty() : own;
}

void vtkMeshHandle::Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output)
{
  smg::deliverHandle(piece, held, this->Internal->targets(), output);
}

void vtkMeshHandle::PrintSelf(ostream& os, vtkIndent indent)
{
  const auto vector = [&os, indent](const char* name, const double* numbers)
  { os << indent << name << ": " << numbers[0] << " " << numbers[1] << " " << numbers[2] << "\n"; };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPointTargets: " << this->GetNumberOfPointTargets() << "\n";
  os << indent << "Motion: " << this->Motion << "\n";
  vector("Translation", this->Translation);
  vector("RotationAxis", this->RotationAxis);
  os << indent << "RotationAngle: " << this->RotationAngle << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
  vector("Center", this->Center);
  os << indent << "Transform: " << this->Transform << "\n";
}
