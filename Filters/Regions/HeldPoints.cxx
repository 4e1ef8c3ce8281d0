// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/HeldPoints.h"

#include "vtkAbstractTransform.h"
#include "vtkBox.h"
#include "vtkCylinder.h"
#include "vtkDataSetAttributes.h"
#include "vtkHomogeneousTransform.h"
#include "vtkImplicitFunction.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPointSet.h"
#include "vtkSphere.h"
#include "vtkUnsignedCharArray.h"

#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <array>
#include <cmath>
#include <sstream>

namespace smg
{

HeldPoints heldByIds(std::span<const std::int64_t> ids, const IdList& sought)
{
  HeldPoints held;
  held.by.reserve(ids.size());
  for (const std::int64_t id : ids)
  {
    held.by.push_back(sought.numberOf(id));
  }
  held.holders = sought.size();
  return held;
}

HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection)
{
  HeldPoints held;
  held.by.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    std::array<double, 3> point;
    mesh.GetPoint(static_cast<vtkIdType>(i), point.data());
    held.by.push_back(projection.influencing(indices[i], point));
  }
  for (const PointProjection::Projected& projected : projection.projected())
  {
    held.anchors.insert(held.anchors.end(), projected.position.begin(), projected.position.end());
  }
  held.holders = static_cast<std::int64_t>(projection.projected().size());
  return held;
}

bool HeldCount::add(vtkPointSet& piece, const HeldPoints& held, const PieceRequest& request)
{
  const bool isNext = request.IsStreamed && request.Pieces == this->Pieces &&
                      request.Piece == this->NextPiece && request.Piece > 0;
  if (!isNext)
  {
    this->Points = this->AllPoints = 0;
    this->Bounds.Reset();
    this->IsHolding.clear();
    this->Pieces = request.IsStreamed && request.Piece == 0 ? request.Pieces : 0;
  }
  this->NextPiece = request.Piece + 1;
  if (held.holders > 0)
  {
    this->IsHolding.resize(static_cast<std::size_t>(held.holders), 0);
  }
  vtkUnsignedCharArray* ghosts = piece.GetPointGhostArray();
  for (vtkIdType i = 0; i < piece.GetNumberOfPoints(); ++i)
  {
    if (ghosts && ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT)
    {
      continue;
    }
    ++this->AllPoints;
    if (!held.by.empty() && held.by[i] >= 0)
    {
      ++this->Points;
      this->Bounds.AddPoint(piece.GetPoint(i));
      this->IsHolding[held.by[i]] = 1;
    }
  }
  return request.IsStreamed ? this->NextPiece == this->Pieces : request.Pieces == 1;
}

namespace
{

void checkDirection(const double* direction, const char* sentence)
{
  if (!(vtkMath::Norm(direction) > 0.0))
  {
    throw Error(sentence);
  }
}

/** The functions use its square, so that the sign would go unnoticed. */
void checkRadius(const char* shape, double radius)
{
  if (!(radius > 0.0))
  {
    std::ostringstream sentence;
    sentence << "The " << shape << " of the region has the radius " << radius
             << ", which must be greater than 0: update the input first, so that the shape can be "
                "fitted to it, or set Radius.";
    throw Error(sentence.str());
  }
}

void check(vtkImplicitFunction* function)
{
  if (!function)
  {
    throw Error(
      "The region has no implicit function: set RegionFunction, or choose another Region.");
  }
  if (auto* plane = vtkPlane::SafeDownCast(function))
  {
    checkDirection(plane->GetNormal(), "The plane of the region has no direction: set Normal.");
  }
  // Such as that of ParaView, a unit cube that is moved, turned and scaled to its lengths.
  auto* const moved = vtkHomogeneousTransform::SafeDownCast(function->GetTransform());
  if (moved && vtkBox::SafeDownCast(function) && moved->GetMatrix()->Determinant() == 0.0)
  {
    throw Error(
      "The box of the region is flat, so that no point is inside: give its Length a small "
      "number instead of 0.");
  }
  if (auto* sphere = vtkSphere::SafeDownCast(function))
  {
    checkRadius("sphere", sphere->GetRadius());
  }
  if (auto* cylinder = vtkCylinder::SafeDownCast(function))
  {
    checkRadius("cylinder", cylinder->GetRadius());
    checkDirection(cylinder->GetAxis(), "The cylinder of the region has no direction: set Axis.");
  }
}

/** How far from the origin the place is that the function measures from. */
double placeOf(vtkImplicitFunction& function)
{
  double place = 0.0;
  if (auto* plane = vtkPlane::SafeDownCast(&function))
  {
    place = vtkMath::Norm(plane->GetOrigin());
  }
  if (auto* sphere = vtkSphere::SafeDownCast(&function))
  {
    place = vtkMath::Norm(sphere->GetCenter()) + sphere->GetRadius();
  }
  if (auto* cylinder = vtkCylinder::SafeDownCast(&function))
  {
    place = vtkMath::Norm(cylinder->GetCenter()) + cylinder->GetRadius();
  }
  if (vtkAbstractTransform* transform = function.GetTransform())
  {
    double origin[3] = { 0.0, 0.0, 0.0 };
    transform->GetInverse()->TransformPoint(origin, origin);
    place += vtkMath::Norm(origin);
  }
  return place;
}

} // namespace

HeldPoints heldByFunction(vtkImplicitFunction* function, bool isInsideOut, vtkPointSet& piece)
{
  check(function);
  HeldPoints held;
  held.holders = 1;
  // Points on the surface are inside, although rounding in the function, as of a turned shape, may
  // put them beyond it.
  constexpr double Rounding = 1e-13;
  const double place = placeOf(*function);
  held.by.resize(static_cast<std::size_t>(piece.GetNumberOfPoints()));
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    double point[3];
    piece.GetPoint(static_cast<vtkIdType>(i), point);
    const double value = function->FunctionValue(point);
    if (!std::isfinite(value))
    {
      throw Error("The implicit function of the region has no finite value at the point (" +
                  shortest(point[0]) + ", " + shortest(point[1]) + ", " + shortest(point[2]) +
                  "): update the input first, so that the function can be fitted to it, or correct "
                  "its numbers.");
    }
    double gradient[3] = { 0.0, 0.0, 0.0 };
    if (value > 0.0)
    {
      function->FunctionGradient(point, gradient);
    }
    const bool isInside =
      value <= vtkMath::Norm(gradient) * Rounding * (vtkMath::Norm(point) + place);
    held.by[i] = isInside != isInsideOut ? 0 : -1;
  }
  return held;
}

} // namespace smg
