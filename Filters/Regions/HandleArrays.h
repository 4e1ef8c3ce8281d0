// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/HeldPoints.h"
#include "smg/DeformationDescription.h"

#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDoubleArray;
class vtkPointData;
class vtkPointSet;
class vtkUnsignedCharArray;

namespace smg
{

/** The point arrays of a piece that store handles (see smg/Deform.h), and where held points were.
 */
class HandleArrays
{
public:
  /** The names of the four arrays that a deformation reads. */
  static const std::array<std::string, 4>& names();
  /** Throws Error unless the points have all four with the correct number of components, and are
   * where the handles held them. */
  static void require(vtkPointSet& mesh);
  /** Whether a handle holds one of the points. */
  static bool holdAny(vtkPointSet& mesh);
  /** Takes the arrays of handles away; what they were shown instead of is shown again. */
  static void removeFrom(vtkPointData& points);
  /** Takes away where held points were, as they will move. */
  static void forgetPlaces(vtkPointData& points);

  /** Starts from the arrays of the points, or from free points if there are none. Throws Error if
   * an array has a wrong number of components. */
  HandleArrays(vtkPointData& input, vtkIdType points);
  ~HandleArrays();

  HandleArrays(const HandleArrays&) = delete;
  HandleArrays& operator=(const HandleArrays&) = delete;

  /** Adds a handle to the point, which is at `place`; the last one counts. */
  void hold(vtkIdType point, const std::array<double, 3>& place,
    const std::array<double, 3>& target, const std::array<double, 3>& rotation, double logScale);

  /** Adds the arrays to the points, of which views then show what is held. */
  void addTo(vtkPointData& output) const;

private:
  vtkNew<vtkUnsignedCharArray> Mask;
  vtkNew<vtkDoubleArray> Target, Rotation, LogScale, Place;
};

/** The targets of the points that a handle holds. */
struct HandleTargets
{
  HandleMotion motion;
  /** The target (x, y, z) of each holder and of the points that it holds; empty: the motion
   * applies. */
  std::vector<double> ofHolders;

  /** Throws Error if a target is not finite. */
  void check() const;
};

/** Sets the output to the piece with the arrays of the handles, with another handle added to its
 * held points. Throws Error if the number of targets is not the number of holders. */
void deliverHandle(
  vtkPointSet& piece, const HeldPoints& held, const HandleTargets& targets, vtkPointSet& output);

} // namespace smg
