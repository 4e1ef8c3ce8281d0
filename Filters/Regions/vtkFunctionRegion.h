// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkHeldPoints.h"

class vtkImplicitFunction;
class vtkPointSet;

namespace smg
{

/**
 * Holds the points where the function is at most 0, or (`isInsideOut`) at least 0. Throws Error if
 * there is no function, if it is a sphere or a cylinder with a radius that is not greater than 0,
 * or if it is not finite at a point.
 */
HeldPoints heldByFunction(vtkImplicitFunction* function, bool isInsideOut, vtkPointSet& piece);

} // namespace smg
