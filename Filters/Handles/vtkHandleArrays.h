// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <string>

class vtkDoubleArray;
class vtkPointData;
class vtkUnsignedCharArray;

namespace smg
{

/** The point arrays that hold handles (see Solver/Deformation/Handles.h) of a piece. */
class HandleArrays
{
public:
  /** The names of the four arrays. */
  static const std::array<std::string, 4>& names();
  /** Throws Error unless the points have the four, and with the right number of components. */
  static void require(vtkPointData& points);

  /**
   * Begins with those that the points have, else with free points. Throws Error if one of them has
   * another number of components.
   */
  HandleArrays(vtkPointData& input, vtkIdType points);
  ~HandleArrays();

  HandleArrays(const HandleArrays&) = delete;
  HandleArrays& operator=(const HandleArrays&) = delete;

  /** One more handle holds the point, and it is this one that counts. */
  void hold(vtkIdType point, const std::array<double, 3>& target,
    const std::array<double, 3>& rotation, double logScale);

  /** Gives the points the arrays. */
  void addTo(vtkPointData& output) const;

private:
  vtkNew<vtkUnsignedCharArray> Mask;
  vtkNew<vtkDoubleArray> Target, Rotation, LogScale;
};

} // namespace smg
