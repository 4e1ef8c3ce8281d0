// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkMarkedRegion.h"

#include "Filters/Regions/vtkMarkedPoints.h"
#include "Filters/Regions/vtkRegionPoints.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkOrdinaryMesh.h"
#include "IO/vtkPieceColumns.h"
#include "IO/vtkPieceStream.h"
#include "smg/Error.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace smg
{

void MarkedRegion::set(const MarkedRegionSettings& settings)
{
  if (!(this->Asked == settings))
  {
    this->Asked = settings;
    this->OnDisplay.reset();
    this->OnMesh.reset();
  }
}

bool MarkedRegion::isByItself(vtkPointSet& piece, const PieceRequest& request) const
{
  if (isPreview(piece))
  {
    // Previews lack the arrays of the cells; their points are points of the mesh.
    return this->Asked.isBoundary() || piece.GetCellData()->HasArray(this->Asked.array.c_str());
  }
  const bool isWhole = !request.IsStreamed && request.Pieces == 1;
  if (!isWhole && isOrdinaryMesh(piece))
  {
    // A filter that solves looks at a piece first, and then requests all of an ordinary mesh.
    if (!request.IsStreamed || hasSeveralProcesses())
    {
      throw Error("The pieces of the mesh have no GlobalIds, so that the region cannot extend "
                  "across them: save the mesh as .vsm and open that.");
    }
    return true;
  }
  return isWhole;
}

vtkPointSet& MarkedRegion::bring(
  const PieceRequest& request, const RegionContext& context, HeldPoints& held)
{
  const auto update = [&context, &request]
  {
    return vtkPointSet::SafeDownCast(
      context.input.update(request.Piece, request.Pieces, request.IsStreamed));
  };
  vtkPointSet* piece = update();
  vtkDataArray* ofPoints =
    this->Asked.isBoundary() ? nullptr : piece->GetPointData()->GetArray(this->Asked.array.c_str());
  if (piece->GetNumberOfPoints() == 0)
  {
    held = {};
  }
  else if (ofPoints)
  {
    held = heldByPointArray(*piece, *ofPoints, this->Asked);
  }
  else if (this->isByItself(*piece, request))
  {
    held = this->OnDisplay.of(request, context.stamp(), [&] { return this->holdShown(*piece); });
  }
  else
  {
    this->find(context);
    piece = update();
    held = HeldPoints{ .by = {}, .holders = 1, .anchors = {} };
    for (const std::int64_t id : globalIdsOf(*piece, "The input"))
    {
      held.by.push_back(this->OnMesh->vertices->contains(id) ? 0 : -1);
    }
  }
  return *piece;
}

HeldPoints MarkedRegion::holdShown(vtkPointSet& mesh) const
{
  if (this->Asked.isBoundary())
  {
    return heldOnBoundary(mesh);
  }
  requireArrays(mesh, { this->Asked.array });
  return heldByCellArray(
    mesh, *mesh.GetCellData()->GetArray(this->Asked.array.c_str()), this->Asked);
}

void MarkedRegion::find(const RegionContext& context)
{
  if (this->OnMesh && this->OnMesh->stamp == context.stamp())
  {
    return;
  }
  this->OnMesh.reset();
  PieceColumns columns{ .all = false, .required = {}, .optional = { CellFlagsName } };
  if (!this->Asked.isBoundary())
  {
    columns.required.insert(this->Asked.array);
  }
  PieceStream stream(context.mesh, { .given = this->Asked.pieces }, columns);
  auto vertices =
    std::make_unique<SelectedVertices>(this->Asked.where(), stream.info(), "The input");
  MeshBlock block;
  while (stream.next(block))
  {
    vertices->add(block);
    context.progress.update(stream.fraction());
  }
  vertices->finish();
  // Only here: requesting pieces may itself update modification times of the pipeline.
  this->OnMesh = Found{ context.stamp(), std::move(vertices) };
}

} // namespace smg
