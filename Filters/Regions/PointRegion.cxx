// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/PointRegion.h"

#include "Filters/Pieces/CellParts.h"
#include "Filters/Pieces/MeshInMemory.h"
#include "Filters/Regions/RegionPoints.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Error.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace smg
{
namespace
{

std::vector<std::int64_t> numbersOfPoints(vtkPointSet& mesh)
{
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(mesh.GetNumberOfPoints()));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/** The points that are held without some of the holders, which are ascending: `hold` finds those of
 * given places. The numbers of the holders stay. */
template <class Hold>
HeldPoints withoutHolders(const std::vector<std::int64_t>& dropped,
  const std::vector<double>& places, HeldPoints held, const Hold& hold)
{
  std::vector<std::int64_t> kept;
  std::vector<double> rest;
  for (std::int64_t i = 0; i < held.holders; ++i)
  {
    if (!std::ranges::binary_search(dropped, i))
    {
      kept.push_back(i);
      rest.insert(rest.end(), places.begin() + 3 * i, places.begin() + 3 * (i + 1));
    }
  }
  held.by.assign(held.by.size(), -1);
  if (kept.empty())
  {
    return held;
  }
  held.by = hold(rest).by;
  for (std::int64_t& holder : held.by)
  {
    holder = holder < 0 ? holder : kept[static_cast<std::size_t>(holder)];
  }
  return held;
}

} // namespace

void DisplayedRegion::set(const PointRegionSettings& settings)
{
  this->Last.reset();
  this->Asked = settings;
  this->Ids = IdList(settings.ids);
}

const HeldPoints& DisplayedRegion::hold(vtkPointSet& mesh, const PieceRequest& request,
  const std::vector<double>& places, const RegionContext& context)
{
  return this->Last.of(
    mesh, request, context.stamp(), [&] { return this->find(mesh, places, context); });
}

HeldPoints DisplayedRegion::find(
  vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const
{
  switch (this->Asked.kind)
  {
    case PointRegionSettings::Kind::Selection:
      return this->holdSelected(mesh, context);
    case PointRegionSettings::Kind::Ids:
      return isPreview(mesh) ? this->holdNear(mesh, places, this->Asked.radius, context)
                             : this->holdIds(mesh, context);
    default:
      return this->holdNear(mesh, this->Asked.points, this->Asked.radius, context);
  }
}

HeldPoints DisplayedRegion::holdSelected(vtkPointSet& mesh, const RegionContext& context) const
{
  if (context.kept.isOfAnother(mesh, *context.selection))
  {
    const double radius = this->Asked.radius < 0.0 ? context.kept.radius() : this->Asked.radius;
    return this->holdNear(mesh, context.kept.places(), radius, context);
  }
  const std::vector<std::int64_t> points = selectPoints(mesh, context);
  context.kept.keep(mesh, *context.selection, points);
  if (this->Asked.radius > 0.0 || (this->Asked.rings > 0 && !isPreview(mesh)))
  {
    return this->holdNear(mesh, positionsOf(mesh, points), this->Asked.radius, context);
  }
  return heldByIds(numbersOfPoints(mesh), IdList(points));
}

HeldPoints DisplayedRegion::holdIds(vtkPointSet& mesh, const RegionContext& context) const
{
  const std::vector<std::int64_t> ids = idsOf(mesh, this->Asked);
  PlacesOfIds places(this->Asked.ids, this->Ids);
  places.seek(mesh, ids);
  if (this->Asked.isSoughtById())
  {
    return heldByIds(ids, this->Ids);
  }
  checkIds(this->Ids, places.isFound());
  return this->holdNear(mesh, places.positions(), this->Asked.radius, context);
}

HeldPoints DisplayedRegion::holdNear(vtkPointSet& mesh, const std::vector<double>& places,
  double asked, const RegionContext& context) const
{
  std::optional<CellParts> parts; // of the same points
  if (!hasSimplices(mesh))
  {
    parts.emplace(mesh, "");
  }
  const MeshInMemory whole(parts ? parts->mesh() : mesh);
  // Edges of a preview are not those of the mesh.
  const int rings = isPreview(mesh) ? 0 : this->Asked.rings;
  const double radius = std::max(0.0, asked);
  const auto project = [&](const std::vector<double>& points)
  {
    PointProjection projection(points, { radius, rings }, whole.cellType());
    MeshBlock block;
    whole.source()->next(block);
    projection.add(block);
    projection.finish(context.progress);
    return projection;
  };
  std::vector<std::int64_t> indices(static_cast<std::size_t>(mesh.GetNumberOfPoints()), -1);
  for (std::int64_t vertex = 0; vertex < whole.vertices(); ++vertex)
  {
    indices[whole.points()[vertex]] = vertex;
  }
  const PointProjection projection = project(places);
  const double edge = isPreview(mesh) ? meanEdgeLength(whole) : 0.0;
  if (isSurfaceOfSolid(mesh))
  {
    if (const auto inside = distantPoints(projection, edge + radius); !inside.empty())
    {
      context.warn(std::to_string(inside.size()) + " of " +
                   std::to_string(projection.projected().size()) +
                   " points of the region are far from the surface of the solid, as those inside "
                   "are, and hold no point of the preview: " +
                   RemedyOfSurface + '.');
      return withoutHolders(inside, places, heldByProjection(mesh, indices, projection),
        [&](const std::vector<double>& rest)
        { return heldByProjection(mesh, indices, project(rest)); });
    }
  }
  else if (!isPreview(mesh) || this->Asked.kind != PointRegionSettings::Kind::Ids)
  {
    warnOfDistant(projection, edge, isPreview(mesh) ? "preview" : "mesh", context);
  }
  return heldByProjection(mesh, indices, projection);
}

void StreamedRegion::set(const PointRegionSettings& settings)
{
  this->OnMesh.reset();
  this->Places.reset();
  this->Asked = settings;
  this->Ids = IdList(settings.ids);
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
    warnOfDistant(*found.projection, 0.0, "mesh", context);
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
  if (context.kept.isOfAnother(*displayed, *context.selection))
  {
    radius = this->Asked.radius < 0.0 ? context.kept.radius() : radius;
    const bool isAlone = radius == 0.0 && this->Asked.rings == 0 && !context.kept.ids().empty();
    found.ids = isAlone ? IdList(context.kept.ids()) : IdList();
    return isAlone ? std::vector<double>() : context.kept.places();
  }
  if (!isPreview && hasSeveralProcesses() && isByNumber(*context.selection))
  {
    throw Error("The selection of the region is by numbers in the pieces of several processes: "
                "select by GlobalIds, or use Ids.");
  }
  const std::vector<std::int64_t> points = selectPoints(*displayed, context);
  context.kept.keep(*displayed, *context.selection, points);
  if (isPreview && this->Asked.radius < 0.0)
  {
    radius = radiusBetween(MeshInMemory(*displayed));
  }
  if (!isPreview && radius == 0.0 && this->Asked.rings == 0)
  {
    const std::vector<std::int64_t> ids = globalIdsOf(*displayed, "The input");
    std::vector<std::int64_t> selected;
    for (const std::int64_t point : points)
    {
      selected.push_back(ids[point]);
    }
    found.ids = IdList(selected);
    return {};
  }
  return positionsOf(*displayed, points);
}

bool PointRegion::set(const PointRegionSettings& settings)
{
  if (this->Asked == settings)
  {
    return false;
  }
  this->Asked = settings;
  this->Ids = IdList(settings.ids);
  this->OnDisplay.set(settings);
  this->OnMesh.set(settings);
  return true;
}

bool PointRegion::isDisplayed(const PieceRequest& request, const RegionContext& context) const
{
  if (request.IsStreamed || request.Pieces == 1)
  {
    return !request.IsStreamed;
  }
  // With several processes each displays a piece, and indices refer to that piece.
  return hasSeveralProcesses() && this->Asked.kind == PointRegionSettings::Kind::Selection &&
         (this->Asked.isAlone() || isByNumber(*context.selection));
}

vtkPointSet& PointRegion::fetchPiece(
  const PieceRequest& request, const RegionContext& context, HeldPoints& held)
{
  this->Asked.check(context.selection != nullptr);
  const auto update = [&context, &request]
  { return vtkPointSet::SafeDownCast(request.update(context.input)); };
  vtkPointSet* piece = update();
  const bool isPreview = smg::isPreview(*piece);
  if (piece->GetNumberOfPoints() == 0)
  {
    held = {};
  }
  // A filter that solves looks at a piece first, and then requests all of an ordinary mesh.
  else if (isPreview || this->isDisplayed(request, context) ||
           (request.IsStreamed && lacksStreamNumbering(*piece) && !hasSeveralProcesses()))
  {
    std::vector<double> places;
    if (isPreview && this->Asked.kind == PointRegionSettings::Kind::Ids)
    {
      places = this->OnMesh.placesOfIds(context);
      piece = update();
    }
    held = this->OnDisplay.hold(*piece, request, places, context);
  }
  else if (this->Asked.isSoughtById())
  {
    const std::vector<std::int64_t> ids = idsOf(*piece, this->Asked);
    PlacesOfIds(this->Asked.ids, this->Ids).seek(*piece, ids);
    held = heldByIds(ids, this->Ids);
  }
  else
  {
    this->OnMesh.find(context);
    piece = update();
    held = this->OnMesh.hold(*piece);
  }
  return *piece;
}

void PointRegion::checkHolders(const std::vector<char>& isHolding) const
{
  // With a radius or rings, an id may hold no point if another id is nearer to all of them.
  if (this->Asked.isSoughtById())
  {
    checkIds(this->Ids, isHolding);
  }
}

PlacesOfIds::PlacesOfIds(const std::vector<std::int64_t>& ids, const IdList& sought)
  : Ids(ids)
  , Sought(sought)
  , Positions(3 * ids.size())
  , IsFound(ids.size(), 0)
{
}

void PlacesOfIds::seek(vtkPointSet& piece, std::span<const std::int64_t> idsOfPoints)
{
  for (std::size_t i = 0; i < idsOfPoints.size(); ++i)
  {
    const std::int64_t number = this->Sought.numberOf(idsOfPoints[i]);
    if (number < 0)
    {
      continue;
    }
    std::array<double, 3> point;
    piece.GetPoint(static_cast<vtkIdType>(i), point.data());
    const auto place = this->Positions.begin() + 3 * number;
    // Copies of a point, as at the border of a piece or at a sharp edge, are where it is.
    if (this->IsFound[number] && !std::equal(point.begin(), point.end(), place))
    {
      throw Error("Points at several places have the id " + std::to_string(idsOfPoints[i]) +
                  ": a filter before this one has made points of its own (as Clip or Subdivide, "
                  "which give them the numbers of others) or joined meshes. Put the region before "
                  "that filter, or choose points by their places.");
    }
    std::ranges::copy(point, place);
    this->IsFound[number] = 1;
  }
}

std::vector<double> PlacesOfIds::positions() const
{
  std::vector<double> positions;
  positions.reserve(this->Positions.size());
  for (const std::int64_t id : this->Ids)
  {
    const auto first = this->Positions.begin() + 3 * this->Sought.numberOf(id);
    positions.insert(positions.end(), first, first + 3);
  }
  return positions;
}

} // namespace smg
