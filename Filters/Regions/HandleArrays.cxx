// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/HandleArrays.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "smg/Deform.h"
#include "smg/Error.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVariantKey.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

namespace smg
{
namespace
{

constexpr std::array<int, 4> ComponentsOfArrays{ 1, 3, 3, 1 }; // of HandleArrays::names()

/** Three numbers a point: where the last handle held it. */
constexpr const char* PlaceName = "HandlePlace";

/** Copies the array of the input with this name to `array`, or fills it with 0. */
void begin(vtkDataArray& array, const std::string& name, int components, vtkPointData& input,
  vtkIdType points)
{
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

namespace
{

/** Throws Error if held points are not where they were held. */
void requirePlaces(vtkPointSet& mesh)
{
  vtkPointData& points = *mesh.GetPointData();
  vtkDataArray* places = points.GetArray(PlaceName);
  vtkDataArray* mask = points.GetArray(HandleMaskName);
  if (!places || places->GetNumberOfComponents() != 3)
  {
    return; // the arrays are those of a script
  }
  // Of filters that compute in single precision.
  constexpr double Rounding = 1e-5;
  const double tolerance = Rounding * mesh.GetLength();
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    if (mask->GetTuple1(i) == 0.0)
    {
      continue; // free, as most are
    }
    std::array<double, 3> point, place;
    mesh.GetPoint(i, point.data());
    places->GetTuple(i, place.data());
    const double size = std::max({ std::fabs(place[0]), std::fabs(place[1]), std::fabs(place[2]) });
    const double distance =
      std::hypot(point[0] - place[0], point[1] - place[1], point[2] - place[2]);
    // Not so without a place.
    if (distance > std::max(tolerance, Rounding * size))
    {
      throw Error(
        "Points that a Mesh Handle holds are no longer where it held them, as its targets are: a "
        "filter behind it moves points or makes new ones. Put that filter before the Mesh Handle.");
    }
  }
}

} // namespace

void HandleArrays::require(vtkPointSet& mesh)
{
  vtkPointData& points = *mesh.GetPointData();
  for (std::size_t i = 0; i < ComponentsOfArrays.size(); ++i)
  {
    const std::string& name = names()[i];
    vtkDataArray* array = points.GetArray(name.c_str());
    if (!array)
    {
      throw Error("The mesh has no numeric point array " + name +
                  ", so it has no handles to deform it by: put a Mesh Handle before this filter.");
    }
    if (const int components = array->GetNumberOfComponents(); components != ComponentsOfArrays[i])
    {
      throw Error("The point array " + name + " has " + std::to_string(components) +
                  " components instead of " + std::to_string(ComponentsOfArrays[i]) +
                  ": let a Mesh Handle make it.");
    }
  }
  requirePlaces(mesh);
}

bool HandleArrays::holdAny(vtkPointSet& mesh)
{
  vtkDataArray* mask = mesh.GetPointData()->GetArray(HandleMaskName);
  return mask && mask->GetNumberOfTuples() > 0 && mask->GetRange()[1] != 0.0;
}

void HandleArrays::removeFrom(vtkPointData& points)
{
  vtkDataArray* mask = points.GetArray(HandleMaskName);
  vtkInformation* kept = mask && mask == points.GetScalars() ? mask->GetInformation() : nullptr;
  vtkInformationVariantKey* key = vtkStreamingMeshKeys::FORMER_SCALARS();
  const std::string shown = kept && kept->Has(key) ? kept->Get(key).ToString() : "";
  for (const std::string& name : names())
  {
    points.RemoveArray(name.c_str());
  }
  if (kept)
  {
    points.SetActiveScalars(shown.c_str());
  }
}

void HandleArrays::forgetPlaces(vtkPointData& points)
{
  points.RemoveArray(PlaceName);
}

HandleArrays::HandleArrays(vtkPointData& input, vtkIdType points)
{
  const std::array<vtkDataArray*, 4> arrays{ this->Mask, this->Target, this->Rotation,
    this->LogScale };
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    begin(*arrays[i], names()[i], ComponentsOfArrays[i], input, points);
  }
  const bool hasPlaces = input.HasArray(PlaceName);
  begin(*this->Place, PlaceName, 3, input, points);
  // Points that a script holds have no place.
  for (vtkIdType i = 0; !hasPlaces && i < points; ++i)
  {
    if (this->Mask->GetValue(i) != 0)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->Place->SetTypedComponent(i, k, std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
}

HandleArrays::~HandleArrays() = default;

void HandleArrays::hold(vtkIdType point, const std::array<double, 3>& place,
  const std::array<double, 3>& target, const std::array<double, 3>& rotation, double logScale)
{
  this->Place->SetTypedTuple(point, place.data());
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
  vtkDataArray* shown = output.GetScalars();
  const std::string name = shown && shown->GetName() ? shown->GetName() : "";
  if (name != HandleMaskName)
  {
    this->Mask->GetInformation()->Set(vtkStreamingMeshKeys::FORMER_SCALARS(), vtkVariant(name));
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{
         this->Mask, this->Target, this->Rotation, this->LogScale, this->Place })
  {
    addResult(output, *array);
  }
  output.SetActiveScalars(HandleMaskName);
}

namespace
{

/** Moves the point by the displacement from the anchor to the target; exact at the anchor. */
std::array<double, 3> moved(
  const std::array<double, 3>& point, const double* anchor, const double* target)
{
  std::array<double, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    result[k] = target[k] + (point[k] - anchor[k]);
  }
  return result;
}

} // namespace

void HandleTargets::check() const
{
  if (!std::all_of(this->ofHolders.begin(), this->ofHolders.end(),
        [](double number) { return std::isfinite(number); }))
  {
    throw Error("A point target of the handle is not a finite number.");
  }
}

void deliverHandle(
  vtkPointSet& piece, const HeldPoints& held, const HandleTargets& targets, vtkPointSet& output)
{
  const std::vector<double>& ofHolders = targets.ofHolders;
  if (!ofHolders.empty() && !held.by.empty() &&
      static_cast<std::int64_t>(ofHolders.size()) != 3 * held.holders)
  {
    throw Error("The handle has " + std::to_string(ofHolders.size() / 3) + " point targets for " +
                std::to_string(held.holders) + " points: give one for each, or none.");
  }
  const HandleMotion& motion = targets.motion;
  HandleArrays arrays(*piece.GetPointData(), piece.GetNumberOfPoints());
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    const std::int64_t holder = held.by[i];
    if (holder < 0)
    {
      continue;
    }
    std::array<double, 3> point;
    piece.GetPoint(static_cast<vtkIdType>(i), point.data());
    const double* anchor = held.anchors.empty() ? point.data() : &held.anchors[3 * holder];
    const std::array<double, 3> target =
      ofHolders.empty() ? motion.apply(point) : moved(point, anchor, &ofHolders[3 * holder]);
    arrays.hold(static_cast<vtkIdType>(i), point, target, motion.rotation(), motion.logScale());
  }
  output.ShallowCopy(&piece);
  arrays.addTo(*output.GetPointData());
}

} // namespace smg
