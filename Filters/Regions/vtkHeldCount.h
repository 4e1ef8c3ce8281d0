// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkPieceRequest.h"
#include "Filters/Regions/vtkHeldPoints.h"

#include "vtkBoundingBox.h"

#include <cstdint>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Counts the held points of the requested pieces, as long as these are requested in order. */
class HeldCount
{
public:
  /**
   * Counts those that the piece owns. Restarts unless this is the next of streamed pieces requested
   * in order.
   * @return whether the whole mesh has been counted now
   */
  bool add(vtkPointSet& piece, const HeldPoints& held, const PieceRequest& request);

  /** The number of held points. */
  std::int64_t points() const { return this->Points; }
  /** The number of all points, held or not. */
  std::int64_t allPoints() const { return this->AllPoints; }
  /** The bounds of the held points; not valid if there are none. */
  const vtkBoundingBox& bounds() const { return this->Bounds; }
  /** The holders that hold points among these. */
  const std::vector<char>& isHolding() const { return this->IsHolding; }

private:
  std::int64_t Points = 0, AllPoints = 0;
  vtkBoundingBox Bounds;
  std::vector<char> IsHolding;
  int Pieces = 0; ///< streamed in order; 0: none
  int NextPiece = 0;
};

} // namespace smg
