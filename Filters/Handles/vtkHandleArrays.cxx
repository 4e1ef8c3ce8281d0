// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Handles/vtkHandleArrays.h"

#include "Solver/Core/Error.h"
#include "Solver/Deformation/Handles.h"

#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <limits>
#include <string>

namespace smg
{
namespace
{

/** Makes `array` a copy of the input's array of that name, or fills it with 0. */
void begin(
  vtkDataArray& array, const char* name, int components, vtkPointData& input, vtkIdType points)
{
  vtkDataArray* present = input.GetArray(name);
  if (!present)
  {
    array.SetNumberOfComponents(components);
    array.SetNumberOfTuples(points);
    array.Fill(0.0);
  }
  else if (present->GetNumberOfComponents() != components || present->GetNumberOfTuples() != points)
  {
    throw Error(std::string("The point array ") + name + " of the input does not have " +
                std::to_string(components) +
                " components a point, so no Mesh Handle made it: take it away or rename it.");
  }
  else
  {
    array.DeepCopy(present);
  }
  array.SetName(name);
}

} // namespace

HandleArrays::HandleArrays(vtkPointData& input, vtkIdType points)
{
  begin(*this->Mask, HandleMaskName, 1, input, points);
  begin(*this->Target, HandleTargetName, 3, input, points);
  begin(*this->Rotation, HandleRotationName, 3, input, points);
  begin(*this->LogScale, HandleLogScaleName, 1, input, points);
}

HandleArrays::~HandleArrays() = default;

void HandleArrays::hold(vtkIdType point, const std::array<double, 3>& target,
  const std::array<double, 3>& rotation, double logScale)
{
  const unsigned char handles = this->Mask->GetValue(point);
  if (handles < std::numeric_limits<unsigned char>::max())
  {
    this->Mask->SetValue(point, static_cast<unsigned char>(handles + 1));
  }
  this->Target->SetTypedTuple(point, target.data());
  this->Rotation->SetTypedTuple(point, rotation.data());
  this->LogScale->SetValue(point, logScale);
}

void HandleArrays::addTo(vtkPointData& output) const
{
  output.AddArray(this->Mask);
  output.AddArray(this->Target);
  output.AddArray(this->Rotation);
  output.AddArray(this->LogScale);
}

} // namespace smg
