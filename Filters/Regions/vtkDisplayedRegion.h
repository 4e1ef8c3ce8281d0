// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/PointRegionSettings.h"
#include "Filters/Regions/vtkHeldPoints.h"
#include "Filters/Regions/vtkRegionContext.h"
#include "Filters/Streaming/vtkPieceRequest.h"

#include <optional>
#include <vector>

class vtkPointSet;

namespace smg
{

/** What a region holds of a mesh that is displayed: of a whole one, a process's part, a preview. */
class DisplayedRegion
{
public:
  /** What is sought from now on; what was found for other settings is forgotten. */
  void set(const PointRegionSettings& settings);

  /**
   * Says which points of the mesh, which was asked for by `request`, are held, and keeps that until
   * the stamp changes. `places` are those of the ids, if the mesh is a preview. Throws Error.
   */
  const HeldPoints& hold(vtkPointSet& mesh, const PieceRequest& request,
    const std::vector<double>& places, const RegionContext& context);

private:
  struct Found
  {
    InputStamp stamp;
    int piece = 0, pieces = 1;
    HeldPoints held;
  };

  HeldPoints find(
    vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const;
  HeldPoints holdSelected(vtkPointSet& mesh, const RegionContext& context) const;
  HeldPoints holdIds(vtkPointSet& mesh, const RegionContext& context) const;
  HeldPoints holdNear(
    vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const;

  PointRegionSettings Asked;
  SoughtIds Ids;
  std::optional<Found> Last;
};

} // namespace smg
