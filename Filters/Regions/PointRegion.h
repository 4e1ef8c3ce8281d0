// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/PieceRequest.h"
#include "Filters/Regions/HeldPoints.h"
#include "Filters/Regions/RegionSettings.h"
#include "Solver/Jobs/Projection/PointProjection.h"

#include <cstdint>
#include <optional>
#include <span>
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
  HeldPoints holdNear(vtkPointSet& mesh, const std::vector<double>& places, double radius,
    const RegionContext& context) const;

  PointRegionSettings Asked;
  IdList Ids;
  KeptHeldPoints Last;
};

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
    IdList ids;
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
  IdList Ids;
  std::optional<Found> OnMesh;
  std::optional<Located> Places;
};

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
  vtkPointSet& fetchPiece(
    const PieceRequest& request, const RegionContext& context, HeldPoints& held);

  /** Throws Error if the holders are ids, which must all hold a point of the mesh, and `isHolding`
   * does not mark one of them. */
  void checkHolders(const std::vector<char>& isHolding) const;

private:
  /** Whether the region refers to the displayed piece. */
  bool isDisplayed(const PieceRequest& request, const RegionContext& context) const;

  PointRegionSettings Asked;
  IdList Ids;
  DisplayedRegion OnDisplay;
  StreamedRegion OnMesh;
};

/** Finds the positions of the points of a mesh with given ids. */
class PlacesOfIds
{
public:
  /** `sought` are the `ids`; both must outlive *this. */
  PlacesOfIds(const std::vector<std::int64_t>& ids, const IdList& sought);

  /** Searches the points of a piece, whose ids are `idsOfPoints`. Throws Error if one of the ids is
   * at several places. */
  void seek(vtkPointSet& piece, std::span<const std::int64_t> idsOfPoints);

  /** The ids found; of equal ids in the list only the first one is marked. */
  const std::vector<char>& isFound() const { return this->IsFound; }

  /** x, y, z of each id, all of which must have been found. */
  std::vector<double> positions() const;

private:
  const std::vector<std::int64_t>& Ids;
  const IdList& Sought;
  std::vector<double> Positions; ///< of the ids that isFound() marks
  std::vector<char> IsFound;
};

} // namespace smg
