// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/PointRegionSettings.h"
#include "Filters/Regions/vtkHeldPoints.h"
#include "Filters/Regions/vtkRegionContext.h"
#include "Solver/Jobs/Projection/PointProjection.h"

#include <optional>
#include <vector>

class vtkPointSet;

namespace smg
{

/** The held points of a streamed mesh, found in a pass over all of its pieces. */
class StreamedRegion
{
public:
  /** Sets the settings; results for other settings are discarded. */
  void set(const PointRegionSettings& settings);

  /** The positions of the ids, searched on the whole mesh unless they are known for this stamp.
   * Throws Error and Cancelled. */
  const std::vector<double>& placesOfIds(const RegionContext& context);

  /** Searches the region on the whole mesh in the same way. */
  void find(const RegionContext& context);

  /** The held points of a piece, after find(). Throws Error if it has no GlobalIds. */
  HeldPoints hold(vtkPointSet& piece) const;

private:
  /** Ids or a projection. */
  struct Found
  {
    InputStamp stamp;
    SoughtIds ids;
    std::optional<PointProjection> projection;
  };
  struct Located
  {
    InputStamp stamp;
    std::vector<double> positions;
  };

  std::vector<double> selectedPlaces(
    const RegionContext& context, double& radius, Found& found) const;

  PointRegionSettings Asked;
  SoughtIds Ids;
  std::optional<Found> OnMesh;
  std::optional<Located> Places;
};

} // namespace smg
