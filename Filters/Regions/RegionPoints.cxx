// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/RegionPoints.h"

#include "Filters/Regions/RegionSettings.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Error.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExtractSelection.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <sstream>
#include <string>

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

double radiusBetween(const MeshInMemory& mesh)
{
  return meanEdgeLength(mesh) / std::sqrt(3.0);
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
  return integersOf(*array);
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

void checkIds(const IdList& ids, const std::vector<char>& isFound)
{
  const std::int64_t missing = ids.firstMissing(isFound);
  if (missing >= 0)
  {
    throw Error("The mesh has no point with the id " + std::to_string(missing) +
                ", which the region holds: correct Ids and Id Type, or the selection.");
  }
}

std::vector<std::int64_t> distantPoints(const PointProjection& projection, double slack)
{
  const double diagonal = projection.diagonal();
  return projection.distantPoints(diagonal > 0.0 ? 0.01 + slack / diagonal : 0.01);
}

void warnOfDistant(
  const PointProjection& projection, double slack, const std::string& mesh, const RegionContext& to)
{
  const std::vector<std::int64_t> distant = distantPoints(projection, slack);
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
           << " points of the region are far from the " << mesh << ": point " << worst
           << " is at a distance of " << projected[worst].distance
           << " from it, where the diagonal of its bounds is " << projection.diagonal()
           << "; the nearest points of the " << mesh << " are held.";
  to.warn(sentence.str());
}

namespace
{

/** vtkExtractSelection aborts the program on unknown content. */
void check(vtkSelection& selection)
{
  if (selection.GetNumberOfNodes() == 0)
  {
    throw Error("The selection of the region is empty: select something on its input and copy the "
                "active selection.");
  }
  for (unsigned int i = 0; i < selection.GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection.GetNode(i);
    const int content = node->GetContentType();
    if (content == vtkSelectionNode::QUERY || content == vtkSelectionNode::USER)
    {
      throw Error(
        "The selection of the region is a query, which only ParaView can evaluate: freeze "
        "it in Find Data, so that it becomes one of ids, and copy it again; in a script use "
        "IDSelectionSource, SelectSurfacePoints or Region Ids.");
    }
    const int field = node->GetFieldType();
    if (field != vtkSelectionNode::POINT && field != vtkSelectionNode::CELL)
    {
      throw Error("The selection of the region is of neither points nor cells: select some.");
    }
  }
}

/** Whether a node of the selection has one of the content types. */
bool hasContent(vtkSelection& selection, std::initializer_list<int> kinds)
{
  for (unsigned int i = 0; i < selection.GetNumberOfNodes(); ++i)
  {
    const int content = selection.GetNode(i)->GetContentType();
    if (std::find(kinds.begin(), kinds.end(), content) != kinds.end())
    {
      return true;
    }
  }
  return false;
}

void sortOnce(std::vector<std::int64_t>& numbers)
{
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/** Whether the selection is the union of its nodes. */
bool isUnion(vtkSelection& selection)
{
  const std::string expression = selection.GetExpression();
  bool isUnion = expression.find_first_of("!&^") == std::string::npos;
  for (unsigned int i = 0; i < selection.GetNumberOfNodes() && !expression.empty(); ++i)
  {
    isUnion = isUnion && expression.find(selection.GetNodeNameAtIndex(i)) != std::string::npos;
  }
  return isUnion;
}

/** The list of a node of the selection that consists of GlobalIds of points only. */
vtkDataArray* globalIdsOfPoints(vtkSelectionNode& node)
{
  vtkInformation* properties = node.GetProperties();
  const auto isSet = [properties](vtkInformationIntegerKey* key)
  { return properties->Has(key) && properties->Get(key) != 0; };
  const bool namesPoints =
    node.GetContentType() == vtkSelectionNode::GLOBALIDS &&
    node.GetFieldType() == vtkSelectionNode::POINT && !isSet(vtkSelectionNode::INVERSE()) &&
    !isSet(vtkSelectionNode::CONTAINING_CELLS()) && !isSet(vtkSelectionNode::CONNECTED_LAYERS());
  auto* list = namesPoints ? vtkDataArray::SafeDownCast(node.GetSelectionList()) : nullptr;
  return list && list->GetNumberOfComponents() == 1 ? list : nullptr;
}

} // namespace

std::optional<std::vector<std::int64_t>> selectedGlobalIds(vtkSelection& selection)
{
  if (!isUnion(selection))
  {
    return std::nullopt;
  }
  std::vector<std::int64_t> ids;
  for (unsigned int i = 0; i < selection.GetNumberOfNodes(); ++i)
  {
    vtkDataArray* list = globalIdsOfPoints(*selection.GetNode(i));
    if (!list)
    {
      return std::nullopt;
    }
    const std::vector<std::int64_t> more = integersOf(*list);
    ids.insert(ids.end(), more.begin(), more.end());
  }
  if (ids.empty())
  {
    return std::nullopt;
  }
  sortOnce(ids);
  return ids;
}

std::vector<std::int64_t> selectedPoints(vtkPointSet& mesh, vtkSelection& selection)
{
  check(selection);
  // A copy, so that the pipeline of the mesh is not affected.
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh.NewInstance());
  copy->ShallowCopy(&mesh);
  vtkNew<vtkExtractSelection> extract;
  extract->SetInputDataObject(0, copy);
  extract->SetInputDataObject(1, &selection);
  extract->Update();
  auto* selected = vtkDataSet::SafeDownCast(extract->GetOutputDataObject(0));
  vtkDataArray* numbers =
    selected ? selected->GetPointData()->GetArray("vtkOriginalPointIds") : nullptr;
  std::vector<std::int64_t> points = numbers ? integersOf(*numbers) : std::vector<std::int64_t>();
  sortOnce(points);
  return points;
}

bool isByNumber(vtkSelection& selection)
{
  return hasContent(selection, { vtkSelectionNode::INDICES });
}

bool isByValue(vtkSelection& selection)
{
  return hasContent(selection, { vtkSelectionNode::THRESHOLDS, vtkSelectionNode::VALUES });
}

} // namespace smg
