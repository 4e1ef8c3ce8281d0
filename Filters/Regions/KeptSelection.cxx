// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/KeptSelection.h"

#include "Filters/Pieces/MeshInMemory.h"
#include "Filters/Regions/RegionPoints.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceStream.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkPointSet.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <cmath>
#include <sstream>

namespace smg
{
namespace
{

/** All that the selected points depend on besides the mesh. */
std::string contentOf(vtkSelection& selection)
{
  std::ostringstream text;
  text << selection.GetExpression();
  for (unsigned int i = 0; i < selection.GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode& node = *selection.GetNode(i);
    text << '\n' << node.GetContentType() << ' ' << node.GetFieldType();
    for (vtkInformationIntegerKey* key :
      { vtkSelectionNode::INVERSE(), vtkSelectionNode::CONTAINING_CELLS(),
        vtkSelectionNode::CONNECTED_LAYERS(), vtkSelectionNode::PROCESS_ID() })
    {
      text << ' ' << node.GetProperties()->Get(key);
    }
    if (auto* list = vtkDataArray::SafeDownCast(node.GetSelectionList()))
    {
      for (vtkIdType k = 0; k < list->GetNumberOfValues(); ++k)
      {
        text << ' ' << list->GetVariantValue(k).ToTypeInt64();
      }
    }
  }
  return text.str();
}

} // namespace

KeptSelection::Shown KeptSelection::of(vtkPointSet& mesh)
{
  const bool isPreview = smg::isPreview(mesh);
  return { isPreview ? pointsBehind(mesh) : mesh.GetNumberOfPoints(),
    isPreview ? cellsBehind(mesh) : mesh.GetNumberOfCells(), mesh.GetNumberOfPoints(), isPreview };
}

bool KeptSelection::isOfAnother(vtkPointSet& shown, vtkSelection& selection) const
{
  // Of several processes each has numbers of its own.
  if (this->Content.empty() || hasSeveralProcesses())
  {
    return false;
  }
  const Shown now = of(shown);
  return !(now == this->On) && (now.isPreview || this->On.isPreview) &&
         now.allPoints == this->On.allPoints && now.allCells == this->On.allCells &&
         contentOf(selection) == this->Content;
}

void KeptSelection::keep(
  vtkPointSet& shown, vtkSelection& selection, const std::vector<std::int64_t>& points)
{
  *this = {};
  if (!isByNumber(selection))
  {
    return;
  }
  this->Content = contentOf(selection);
  this->On = of(shown);
  this->Places = positionsOf(shown, points);
  if (this->On.isPreview)
  {
    this->Radius = hasSimplices(shown) ? radiusBetween(MeshInMemory(shown)) : 0.0;
  }
  else if (globalIdArray(shown))
  {
    const std::vector<std::int64_t> ids = globalIdsOf(shown, "The input");
    for (const std::int64_t point : points)
    {
      this->Ids.push_back(ids[static_cast<std::size_t>(point)]);
    }
  }
}

} // namespace smg
