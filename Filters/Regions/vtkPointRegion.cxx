// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkPointRegion.h"

#include "Filters/Regions/vtkRegionPoints.h"
#include "Filters/Regions/vtkSelectedPoints.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkOrdinaryMesh.h"

#include "vtkPointSet.h"

namespace smg
{

bool PointRegion::set(const PointRegionSettings& settings)
{
  if (this->Asked == settings)
  {
    return false;
  }
  this->Asked = settings;
  this->Ids = SoughtIds(settings.ids);
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

vtkPointSet& PointRegion::bring(
  const PieceRequest& request, const RegionContext& context, HeldPoints& held)
{
  this->Asked.check(context.selection != nullptr);
  const auto update = [&context, &request]
  {
    return vtkPointSet::SafeDownCast(
      context.input.update(request.Piece, request.Pieces, request.IsStreamed));
  };
  vtkPointSet* piece = update();
  const bool isPreview = smg::isPreview(*piece);
  if (piece->GetNumberOfPoints() == 0)
  {
    held = {};
  }
  // A filter that solves looks at a piece first, and then requests all of an ordinary mesh.
  else if (isPreview || this->isDisplayed(request, context) ||
           (request.IsStreamed && isOrdinaryMesh(*piece) && !hasSeveralProcesses()))
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
    held = heldByIds(idsOf(*piece, this->Asked), this->Ids);
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

} // namespace smg
