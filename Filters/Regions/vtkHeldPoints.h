// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkInputStamp.h"
#include "Filters/Pieces/vtkPieceRequest.h"
#include "Filters/Regions/SoughtIds.h"
#include "Solver/Jobs/Projection/PointProjection.h"

#include <cstdint>
#include <span>
#include <vector>

class vtkPointSet;

namespace smg
{

/** The held points of a piece and their holders. A *holder* is a point of the region: a selected
 * point, an id, a position, or the region as a whole. */
struct HeldPoints
{
  std::vector<std::int64_t> by; ///< index of the holder of each point; -1: free
  std::int64_t holders = 0;
  /** The position of the mesh point at each holder; empty: each point is its own anchor. */
  std::vector<double> anchors;
};

/** The held points of a displayed mesh, kept as long as the request and the stamp are the same. */
class KeptHeldPoints
{
public:
  /** Those that are kept, or else those that `find()` returns. */
  template <class Find>
  const HeldPoints& of(const PieceRequest& request, const InputStamp& stamp, Find&& find)
  {
    if (!this->IsKept || this->Stamp != stamp || this->Piece != request.Piece ||
        this->Pieces != request.Pieces)
    {
      this->reset(); // find() may throw
      this->Held = find();
      this->Stamp = stamp;
      this->Piece = request.Piece;
      this->Pieces = request.Pieces;
      this->IsKept = true;
    }
    return this->Held;
  }

  void reset() { *this = {}; }

private:
  HeldPoints Held;
  InputStamp Stamp;
  int Piece = 0, Pieces = 1;
  bool IsKept = false;
};

/** The points of the mesh whose `ids` (one per point) are in the list. */
HeldPoints heldByIds(std::span<const std::int64_t> ids, const SoughtIds& sought);

/** The points of the mesh, with their stream indices, in the range of the projected points. */
HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection);

} // namespace smg
