// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkHeldPoints.h"
#include "Filters/Streaming/vtkPieceRequest.h"

#include <cstdint>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Counts the held points of the pieces that are asked for, as long as that is in order. */
class HeldCount
{
public:
  /**
   * Counts those that the piece owns. Begins anew unless this is the next of streamed pieces that
   * are asked for in order.
   * @return whether the whole mesh has been counted now
   */
  bool add(vtkPointSet& piece, const HeldPoints& held, const PieceRequest& request);

  /** How many points are held. */
  std::int64_t points() const { return this->Points; }
  /** How many there are, held or not. */
  std::int64_t allPoints() const { return this->AllPoints; }
  /** Which of the holders hold points among these. */
  const std::vector<char>& isHolding() const { return this->IsHolding; }

private:
  std::int64_t Points = 0, AllPoints = 0;
  std::vector<char> IsHolding;
  int Pieces = 0; ///< that are streamed in order; 0: none are
  int NextPiece = 0;
};

} // namespace smg
