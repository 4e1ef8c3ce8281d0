// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/PointRegionSettings.h"
#include "Filters/Regions/vtkHeldPoints.h"
#include "Filters/Regions/vtkRegionContext.h"
#include "Solver/Projection/PointProjection.h"

#include <optional>
#include <vector>

class vtkPointSet;

namespace smg
{

/** What a region holds of a mesh that is streamed, found in a pass over all of its pieces. */
class StreamedRegion
{
public:
  /** What is sought from now on; what was found for other settings is forgotten. */
  void set(const PointRegionSettings& settings);

  /**
   * The places of the ids, which are sought on the whole mesh if that has not been done for this
   * stamp. Throws Error and Cancelled.
   */
  const std::vector<double>& placesOfIds(const RegionContext& context);

  /** Seeks the region on the whole mesh in the same way. */
  void find(const RegionContext& context);

  /** Which points of a piece are held, after find(). Throws Error if it has no GlobalIds. */
  HeldPoints hold(vtkPointSet& piece) const;

private:
  /** Ids, or else a projection. */
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
