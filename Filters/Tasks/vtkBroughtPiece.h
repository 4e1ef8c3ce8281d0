// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkPieceRequest.h"
#include "Filters/Tasks/vtkSolutionExchange.h"
#include "IO/vtkPieceInput.h"

#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

namespace smg
{

/** Updates the input to a requested piece. Throws InputFailed. */
inline vtkSmartPointer<vtkPointSet> bring(
  PieceInput& input, const PieceRequest& request, const SolutionExchange& exchange)
{
  vtkSmartPointer<vtkPointSet> piece =
    vtkPointSet::SafeDownCast(input.update(request.Piece, request.Pieces, request.IsStreamed));
  if (!exchange.isParallel())
  {
    return piece;
  }
  // Process 0 will request other pieces, and a repeated request for this one may need all
  // processes.
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(piece->NewInstance());
  copy->ShallowCopy(piece);
  return copy;
}

} // namespace smg
