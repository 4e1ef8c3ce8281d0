// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkPieceRequest.h"
#include "Filters/Regions/PointRegionSettings.h"
#include "Filters/Regions/vtkHeldPoints.h"
#include "Filters/Regions/vtkRegionContext.h"

#include <vector>

class vtkPointSet;

namespace smg
{

/** The held points of a displayed mesh: a whole one, the piece of a process, or a preview. */
class DisplayedRegion
{
public:
  /** Sets the settings; results for other settings are discarded. */
  void set(const PointRegionSettings& settings);

  /** Returns the held points of the mesh requested by `request`, and keeps them until the stamp
   * changes. `places` are the positions of the ids, if the mesh is a preview. Throws Error. */
  const HeldPoints& hold(vtkPointSet& mesh, const PieceRequest& request,
    const std::vector<double>& places, const RegionContext& context);

private:
  HeldPoints find(
    vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const;
  HeldPoints holdSelected(vtkPointSet& mesh, const RegionContext& context) const;
  HeldPoints holdIds(vtkPointSet& mesh, const RegionContext& context) const;
  HeldPoints holdNear(
    vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const;

  PointRegionSettings Asked;
  SoughtIds Ids;
  KeptHeldPoints Last;
};

} // namespace smg
