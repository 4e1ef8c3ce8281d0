// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkDisplayedRegion.h"
#include "Filters/Regions/vtkStreamedRegion.h"

namespace smg
{

/** A region that single points of the mesh make: selected ones, or given by ids or places. */
class PointRegion
{
public:
  /**
   * What is sought from now on; what was found for other settings is forgotten.
   * @return whether the settings are others than before
   */
  bool set(const PointRegionSettings& settings);

  /**
   * Brings the input to the piece asked for and says which of its points are held. What that needs
   * of the mesh is found first, and kept until the settings or the stamp change. Throws Error and
   * Cancelled.
   */
  vtkPointSet& bring(const PieceRequest& request, const RegionContext& context, HeldPoints& held);

  /**
   * Throws Error if each holder must hold a point of the mesh, since it is an id, and one of them
   * is not among those that `isHolding` marks.
   */
  void checkHolders(const std::vector<char>& isHolding) const;

private:
  /** Whether the region is what it is in the piece that is displayed. */
  bool isDisplayed(const PieceRequest& request, const RegionContext& context) const;

  PointRegionSettings Asked;
  SoughtIds Ids;
  DisplayedRegion OnDisplay;
  StreamedRegion OnMesh;
};

} // namespace smg
