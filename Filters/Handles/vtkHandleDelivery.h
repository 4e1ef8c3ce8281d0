// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkHeldPoints.h"
#include "smg/DeformationDescription.h"

#include <vector>

class vtkPointSet;

namespace smg
{

/** Where the points that a handle holds go. */
struct HandleTargets
{
  HandleMotion motion;
  /** x, y, z of where each holder goes, with what it holds; empty: the motion says so. */
  std::vector<double> ofHolders;

  /** Throws Error if a target is not finite. */
  void check() const;
};

/**
 * Gives the output the piece with the arrays of the handles, in which its held points are those of
 * one more handle. Throws Error if the targets are not as many as the holders.
 */
void deliverHandle(
  vtkPointSet& piece, const HeldPoints& held, const HandleTargets& targets, vtkPointSet& output);

} // namespace smg
