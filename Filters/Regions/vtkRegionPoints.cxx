// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkRegionPoints.h"

#include "Filters/Regions/EdgeLength.h"
#include "Filters/Regions/vtkSelectedPoints.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/vtkOrdinaryMesh.h"
#include "IO/vtkPieceStream.h"
#include "smg/Error.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace smg
{

std::vector<double> positionsOf(vtkPointSet& mesh, const std::vector<std::int64_t>& points)
{
  std::vector<double> positions(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.GetPoint(points[i], positions.data() + 3 * i);
  }
  return positions;
}

double meanEdgeLength(const MeshInMemory& mesh)
{
  MeshBlock block;
  mesh.source()->next(block);
  return smg::meanEdgeLength(block, mesh.cellType());
}

std::vector<std::int64_t> idsOf(vtkPointSet& mesh, const PointRegionSettings& settings)
{
  if (!settings.areOriginalIds && !globalIdArray(mesh) && !hasSeveralProcesses())
  {
    std::vector<std::int64_t> places(static_cast<std::size_t>(mesh.GetNumberOfPoints()));
    std::iota(places.begin(), places.end(), 0);
    return places;
  }
  if (!settings.areOriginalIds)
  {
    return globalIdsOf(mesh, "The input");
  }
  vtkDataArray* array = mesh.GetPointData()->GetArray(OriginalIdName);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw Error(std::string("The input has no point array ") + OriginalIdName +
                " to seek the ids in: choose Global Ids, or let the reader read that array.");
  }
  std::vector<std::int64_t> ids(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ids[i] = static_cast<std::int64_t>(array->GetTuple1(static_cast<vtkIdType>(i)));
  }
  return ids;
}

std::vector<std::int64_t> selectPoints(vtkPointSet& mesh, const RegionContext& context)
{
  std::vector<std::int64_t> points = selectedPoints(mesh, *context.selection);
  // With several processes, one may have no part of the selection.
  if (points.empty() && !hasSeveralProcesses())
  {
    throw Error("The selection of the region selects no point of its input: select something on "
                "that and copy the active selection.");
  }
  return points;
}

void checkIds(const SoughtIds& ids, const std::vector<char>& isFound)
{
  const std::int64_t missing = ids.firstMissing(isFound);
  if (missing >= 0)
  {
    throw Error("The mesh has no point with the id " + std::to_string(missing) +
                ", which the region holds: correct Ids and Id Type, or the selection.");
  }
}

void warnOfDistant(const PointProjection& projection, double slack, const RegionContext& to)
{
  const double diagonal = projection.diagonal();
  const std::vector<std::int64_t> distant =
    projection.distantPoints(diagonal > 0.0 ? 0.01 + slack / diagonal : 0.01);
  if (distant.empty())
  {
    return;
  }
  const auto& projected = projection.projected();
  const std::int64_t worst = *std::max_element(distant.begin(), distant.end(),
    [&projected](std::int64_t a, std::int64_t b)
    { return projected[a].distance < projected[b].distance; });
  std::ostringstream sentence;
  sentence << distant.size() << " of " << projected.size()
           << " points of the region are far from the mesh: point " << worst
           << " is at a distance of " << projected[worst].distance
           << " from it, where the diagonal of its bounds is " << diagonal
           << "; the nearest points of the mesh are held.";
  to.warn(sentence.str());
}

} // namespace smg
