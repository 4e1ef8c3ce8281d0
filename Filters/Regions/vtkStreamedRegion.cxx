// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkStreamedRegion.h"

#include "Filters/Regions/vtkPlacesOfIds.h"
#include "Filters/Regions/vtkRegionPoints.h"
#include "Filters/Regions/vtkSelectedPoints.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkOrdinaryMesh.h"
#include "IO/vtkPieceStream.h"
#include "smg/Error.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>

namespace smg
{

void StreamedRegion::set(const PointRegionSettings& settings)
{
  this->OnMesh.reset();
  this->Places.reset();
  this->Asked = settings;
  this->Ids = SoughtIds(settings.ids);
}

const std::vector<double>& StreamedRegion::placesOfIds(const RegionContext& context)
{
  if (this->Places && this->Places->stamp == context.stamp())
  {
    return this->Places->positions;
  }
  PlacesOfIds places(this->Asked.ids, this->Ids);
  PieceStream stream(context.mesh, { .given = this->Asked.pieces }, {});
  MeshBlock block;
  while (vtkPointSet* piece = stream.nextPiece(block))
  {
    places.seek(*piece, idsOf(*piece, this->Asked));
    context.progress.update(stream.fraction());
  }
  checkIds(this->Ids, places.isFound());
  this->Places = Located{ context.stamp(), places.positions() };
  return this->Places->positions;
}

void StreamedRegion::find(const RegionContext& context)
{
  if (this->OnMesh && this->OnMesh->stamp == context.stamp())
  {
    return;
  }
  Found found;
  double radius = std::max(0.0, this->Asked.radius);
  std::vector<double> places = this->Asked.points;
  if (this->Asked.kind == PointRegionSettings::Kind::Ids)
  {
    places = this->placesOfIds(context);
  }
  else if (this->Asked.kind == PointRegionSettings::Kind::Selection)
  {
    places = this->selectedPlaces(context, radius, found);
  }
  if (!places.empty())
  {
    PieceStream stream(context.mesh, { .given = this->Asked.pieces }, {});
    found.projection.emplace(
      places, PointProjection::Influence{ radius, this->Asked.rings }, stream.info().cellType);
    MeshBlock block;
    while (stream.next(block))
    {
      found.projection->add(block);
      context.progress.update(stream.fraction());
    }
    found.projection->finish(context.progress);
    warnOfDistant(*found.projection, 0.0, context);
  }
  // Only here: requesting pieces may itself update modification times of the pipeline.
  found.stamp = context.stamp();
  this->OnMesh = std::move(found);
}

HeldPoints StreamedRegion::hold(vtkPointSet& piece) const
{
  const std::vector<std::int64_t> ids = globalIdsOf(piece, "The input");
  return this->OnMesh->projection ? heldByProjection(piece, ids, *this->OnMesh->projection)
                                  : heldByIds(ids, this->OnMesh->ids);
}

std::vector<double> StreamedRegion::selectedPlaces(
  const RegionContext& context, double& radius, Found& found) const
{
  auto* displayed = vtkPointSet::SafeDownCast(context.input.update(0, 1, false));
  const bool isPreview = smg::isPreview(*displayed);
  if (!isPreview && hasSeveralProcesses() && isByNumber(*context.selection))
  {
    throw Error("The selection of the region is by numbers in the pieces of several processes: "
                "select by GlobalIds, or use Ids.");
  }
  const std::vector<std::int64_t> points = selectPoints(*displayed, context);
  if (isPreview && this->Asked.radius < 0.0)
  {
    // Balls of this radius around the corners of triangles with this edge length leave no gap.
    radius = meanEdgeLength(MeshInMemory(*displayed)) / std::sqrt(3.0);
  }
  if (!isPreview && radius == 0.0 && this->Asked.rings == 0)
  {
    const std::vector<std::int64_t> ids = globalIdsOf(*displayed, "The input");
    std::vector<std::int64_t> selected;
    for (const std::int64_t point : points)
    {
      selected.push_back(ids[point]);
    }
    found.ids = SoughtIds(selected);
    return {};
  }
  return positionsOf(*displayed, points);
}

} // namespace smg
