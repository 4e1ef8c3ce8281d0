// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkDisplayedRegion.h"
#include "Filters/Regions/vtkStreamedRegion.h"

namespace smg
{

/** A region of single points of the mesh: selected points, or points given by ids or positions. */
class PointRegion
{
public:
  /**
   * Sets the settings; results for other settings are discarded.
   * @return whether the settings have changed
   */
  bool set(const PointRegionSettings& settings);

  /**
   * Updates the input to the requested piece and determines its held points. The required data of
   * the mesh are computed first and kept until the settings or the stamp change. Throws Error and
   * Cancelled.
   */
  vtkPointSet& bring(const PieceRequest& request, const RegionContext& context, HeldPoints& held);

  /** Throws Error if the holders are ids, which must all hold a point of the mesh, and `isHolding`
   * does not mark one of them. */
  void checkHolders(const std::vector<char>& isHolding) const;

private:
  /** Whether the region refers to the displayed piece. */
  bool isDisplayed(const PieceRequest& request, const RegionContext& context) const;

  PointRegionSettings Asked;
  SoughtIds Ids;
  DisplayedRegion OnDisplay;
  StreamedRegion OnMesh;
};

} // namespace smg
