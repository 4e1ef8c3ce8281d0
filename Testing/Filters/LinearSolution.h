// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/vtkStreamingPoisson.h"
#include "Testing/IO/PieceTesting.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>

namespace smg::testing
{

/** Solves with the point array X, x + 2 y - z, prescribed outside of a ball in the middle. */
inline vtkPointSet* solveLinear(vtkStreamingPoisson& poisson, vtkPointSet* mesh)
{
  vtkNew<vtkDoubleArray> linear, mask;
  linear->SetName("X");
  mask->SetName("Mask");
  double box[6], centre[3], sides[3];
  mesh->GetBounds(box);
  for (int axis = 0; axis < 3; ++axis)
  {
    centre[axis] = 0.5 * (box[2 * axis] + box[2 * axis + 1]);
    sides[axis] = box[2 * axis + 1] - box[2 * axis];
  }
  std::sort(sides, sides + 3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* p = mesh->GetPoint(i);
    linear->InsertNextValue(p[0] + 2.0 * p[1] - p[2]);
    const double away = std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]);
    mask->InsertNextValue(away > 0.3 * sides[1] ? 1.0 : 0.0);
  }
  mesh->GetPointData()->AddArray(linear);
  mesh->GetPointData()->AddArray(mask);
  poisson.SetInputDataObject(mesh);
  poisson.SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mask");
  poisson.SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "X");
  poisson.SetTolerance(1e-10);
  updatePiece(&poisson, 0, 1);
  return vtkPointSet::SafeDownCast(poisson.GetOutputDataObject(0));
}

} // namespace smg::testing
