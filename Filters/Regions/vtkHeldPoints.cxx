// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkHeldPoints.h"

#include "vtkDataSetAttributes.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <array>

namespace smg
{

HeldPoints heldByIds(std::span<const std::int64_t> ids, const IdList& sought)
{
  HeldPoints held;
  held.by.reserve(ids.size());
  for (const std::int64_t id : ids)
  {
    held.by.push_back(sought.numberOf(id));
  }
  held.holders = sought.size();
  return held;
}

HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection)
{
  HeldPoints held;
  held.by.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    std::array<double, 3> point;
    mesh.GetPoint(static_cast<vtkIdType>(i), point.data());
    held.by.push_back(projection.influencing(indices[i], point));
  }
  for (const PointProjection::Projected& projected : projection.projected())
  {
    held.anchors.insert(held.anchors.end(), projected.position.begin(), projected.position.end());
  }
  held.holders = static_cast<std::int64_t>(projection.projected().size());
  return held;
}

bool HeldCount::add(vtkPointSet& piece, const HeldPoints& held, const PieceRequest& request)
{
  const bool isNext = request.IsStreamed && request.Pieces == this->Pieces &&
                      request.Piece == this->NextPiece && request.Piece > 0;
  if (!isNext)
  {
    this->Points = this->AllPoints = 0;
    this->Bounds.Reset();
    this->IsHolding.clear();
    this->Pieces = request.IsStreamed && request.Piece == 0 ? request.Pieces : 0;
  }
  this->NextPiece = request.Piece + 1;
  if (held.holders > 0)
  {
    this->IsHolding.resize(static_cast<std::size_t>(held.holders), 0);
  }
  vtkUnsignedCharArray* ghosts = piece.GetPointGhostArray();
  for (vtkIdType i = 0; i < piece.GetNumberOfPoints(); ++i)
  {
    if (ghosts && ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT)
    {
      continue;
    }
    ++this->AllPoints;
    if (!held.by.empty() && held.by[i] >= 0)
    {
      ++this->Points;
      this->Bounds.AddPoint(piece.GetPoint(i));
      this->IsHolding[held.by[i]] = 1;
    }
  }
  return request.IsStreamed ? this->NextPiece == this->Pieces : request.Pieces == 1;
}

} // namespace smg
