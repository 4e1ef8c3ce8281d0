// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkFunctionRegion.h"

#include "smg/Error.h"

#include "vtkCylinder.h"
#include "vtkImplicitFunction.h"
#include "vtkMath.h"
#include "vtkPlane.h"
#include "vtkPointSet.h"
#include "vtkSphere.h"

#include <cmath>
#include <sstream>

namespace smg
{
namespace
{

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
  if (auto* plane = vtkPlane::SafeDownCast(function);
      plane && vtkMath::Norm(plane->GetNormal()) == 0.0)
  {
    throw Error("The plane of the region has no direction: set Normal.");
  }
  if (auto* sphere = vtkSphere::SafeDownCast(function))
  {
    checkRadius("sphere", sphere->GetRadius());
  }
  if (auto* cylinder = vtkCylinder::SafeDownCast(function))
  {
    checkRadius("cylinder", cylinder->GetRadius());
  }
}

} // namespace

HeldPoints heldByFunction(vtkImplicitFunction* function, bool isInsideOut, vtkPointSet& piece)
{
  check(function);
  HeldPoints held;
  held.holders = 1;
  held.by.resize(static_cast<std::size_t>(piece.GetNumberOfPoints()));
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    double point[3];
    piece.GetPoint(static_cast<vtkIdType>(i), point);
    const double value = function->FunctionValue(point);
    if (!std::isfinite(value))
    {
      std::ostringstream sentence;
      sentence << "The implicit function of the region has no finite value at the point ("
               << point[0] << ", " << point[1] << ", " << point[2]
               << "): update the input first, so that the function can be fitted to it, or correct "
                  "its numbers.";
      throw Error(sentence.str());
    }
    held.by[i] = (isInsideOut ? value >= 0.0 : value <= 0.0) ? 0 : -1;
  }
  return held;
}

} // namespace smg
