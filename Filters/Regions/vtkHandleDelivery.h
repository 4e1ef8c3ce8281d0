// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkHeldPoints.h"
#include "smg/DeformationDescription.h"

#include <vector>

class vtkPointSet;

namespace smg
{

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
