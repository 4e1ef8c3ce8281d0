// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkHandleArrays.h"

#include "smg/Deform.h"
#include "smg/Error.h"

#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <limits>
#include <string>

namespace smg
{
namespace
{

constexpr std::array<int, 4> Components{ 1, 3, 3, 1 }; // of HandleArrays::names()

/** Copies the array of the input with index `place` in names() to `array`, or fills it with 0. */
void begin(vtkDataArray& array, std::size_t place, vtkPointData& input, vtkIdType points)
{
  const std::string& name = HandleArrays::names()[place];
  const int components = Components[place];
  vtkDataArray* present = input.GetArray(name.c_str());
  if (!present)
  {
    array.SetNumberOfComponents(components);
    array.SetNumberOfTuples(points);
    array.Fill(0.0);
  }
  else if (present->GetNumberOfComponents() != components || present->GetNumberOfTuples() != points)
  {
    throw Error("The point array " + name + " of the input does not have " +
                std::to_string(components) +
                " components a point, so no Mesh Handle made it: take it away or rename it.");
  }
  else
  {
    array.DeepCopy(present);
  }
  array.SetName(name.c_str());
}

} // namespace

const std::array<std::string, 4>& HandleArrays::names()
{
  static const std::array<std::string, 4> names{ HandleMaskName, HandleTargetName,
    HandleRotationName, HandleLogScaleName };
  return names;
}

void HandleArrays::require(vtkPointData& points)
{
  for (std::size_t i = 0; i < Components.size(); ++i)
  {
    const std::string& name = names()[i];
    vtkDataArray* array = points.GetArray(name.c_str());
    if (!array)
    {
      throw Error("The mesh has no numeric point array " + name +
                  ", so it has no handles to deform it by: put a Mesh Handle before this filter.");
    }
    if (const int components = array->GetNumberOfComponents(); components != Components[i])
    {
      throw Error("The point array " + name + " has " + std::to_string(components) +
                  " components instead of " + std::to_string(Components[i]) +
                  ": let a Mesh Handle make it.");
    }
  }
}

HandleArrays::HandleArrays(vtkPointData& input, vtkIdType points)
{
  begin(*this->Mask, 0, input, points);
  begin(*this->Target, 1, input, points);
  begin(*this->Rotation, 2, input, points);
  begin(*this->LogScale, 3, input, points);
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
