// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkDisplayedRegion.h"

#include "Filters/Pieces/vtkCellParts.h"
#include "Filters/Pieces/vtkMeshInMemory.h"
#include "Filters/Regions/vtkPlacesOfIds.h"
#include "Filters/Regions/vtkRegionPoints.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkPieceCells.h"

#include "vtkPointSet.h"

#include <algorithm>
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

} // namespace

void DisplayedRegion::set(const PointRegionSettings& settings)
{
  this->Last.reset();
  this->Asked = settings;
  this->Ids = SoughtIds(settings.ids);
}

const HeldPoints& DisplayedRegion::hold(vtkPointSet& mesh, const PieceRequest& request,
  const std::vector<double>& places, const RegionContext& context)
{
  return this->Last.of(request, context.stamp(), [&] { return this->find(mesh, places, context); });
}

HeldPoints DisplayedRegion::find(
  vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const
{
  switch (this->Asked.kind)
  {
    case PointRegionSettings::Kind::Selection:
      return this->holdSelected(mesh, context);
    case PointRegionSettings::Kind::Ids:
      return isPreview(mesh) ? this->holdNear(mesh, places, context) : this->holdIds(mesh, context);
    default:
      return this->holdNear(mesh, this->Asked.points, context);
  }
}

HeldPoints DisplayedRegion::holdSelected(vtkPointSet& mesh, const RegionContext& context) const
{
  const std::vector<std::int64_t> points = selectPoints(mesh, context);
  if (this->Asked.radius > 0.0 || (this->Asked.rings > 0 && !isPreview(mesh)))
  {
    return this->holdNear(mesh, positionsOf(mesh, points), context);
  }
  return heldByIds(numbersOfPoints(mesh), SoughtIds(points));
}

HeldPoints DisplayedRegion::holdIds(vtkPointSet& mesh, const RegionContext& context) const
{
  const std::vector<std::int64_t> ids = idsOf(mesh, this->Asked);
  if (this->Asked.isSoughtById())
  {
    return heldByIds(ids, this->Ids);
  }
  PlacesOfIds places(this->Asked.ids, this->Ids);
  places.seek(mesh, ids);
  checkIds(this->Ids, places.isFound());
  return this->holdNear(mesh, places.positions(), context);
}

HeldPoints DisplayedRegion::holdNear(
  vtkPointSet& mesh, const std::vector<double>& places, const RegionContext& context) const
{
  std::optional<CellParts> parts; // of the same points
  if (!hasSimplices(mesh))
  {
    parts.emplace(mesh, "");
  }
  const MeshInMemory whole(parts ? parts->mesh() : mesh);
  // Edges of a preview are not those of the mesh.
  const int rings = isPreview(mesh) ? 0 : this->Asked.rings;
  PointProjection projection(
    places, { std::max(0.0, this->Asked.radius), rings }, whole.cellType());
  MeshBlock block;
  whole.source()->next(block);
  projection.add(block);
  projection.finish(context.progress);
  warnOfDistant(projection, isPreview(mesh) ? meanEdgeLength(whole) : 0.0, context);
  std::vector<std::int64_t> indices(static_cast<std::size_t>(mesh.GetNumberOfPoints()), -1);
  for (std::int64_t vertex = 0; vertex < whole.vertices(); ++vertex)
  {
    indices[whole.points()[vertex]] = vertex;
  }
  return heldByProjection(mesh, indices, projection);
}

} // namespace smg
