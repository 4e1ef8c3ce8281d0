// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace smg
{

/** A request for a piece, in the pipeline information of an output or of an input. */
struct PieceRequest
{
  explicit PieceRequest(vtkInformation* info)
    : Piece(info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()))
    , Pieces(std::max(1, info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES())))
    , IsStreamed(vtkStreamingMeshKeys::IsStreamed(info))
  {
    const int levels = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
    this->GhostLevels = this->Pieces > 1 && !hasSeveralProcesses() ? std::max(0, levels) : 0;
  }

  /** Updates the input to the same piece. Throws InputFailed. */
  vtkDataObject* update(PieceInput& input) const
  {
    return input.update(this->Piece, this->Pieces, this->IsStreamed, this->GhostLevels);
  }

  /** Requests an empty piece from the input: the one after the last. */
  void forwardEmptyTo(vtkInformation* input) const
  {
    PieceRequest empty = *this;
    empty.Piece = this->Pieces;
    empty.IsStreamed = false;
    empty.GhostLevels = 0;
    empty.forwardTo(input);
  }

  /** Requests the same piece from the input. */
  void forwardTo(vtkInformation* input) const
  {
    using vtkSDDP = vtkStreamingDemandDrivenPipeline;
    input->Set(vtkSDDP::UPDATE_PIECE_NUMBER(), this->Piece);
    input->Set(vtkSDDP::UPDATE_NUMBER_OF_PIECES(), this->Pieces);
    input->Set(vtkSDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), this->GhostLevels);
    input->Set(vtkStreamingMeshKeys::STREAMED(), this->IsStreamed ? this->Pieces : 0);
  }

  int Piece;
  int Pieces;
  bool IsStreamed; ///< whether the real piece is requested, not a preview
  /** Layers of ghost cells around the piece; with several processes there are none. */
  int GhostLevels = 0;
};

/**
 * The state that results computed from an input depend on: they are valid while it is unchanged.
 */
struct InputStamp
{
  unsigned long long filter = 0; ///< modification time of the filter
  unsigned long long input = 0;  ///< modification time of the pipeline before it
  double time = 0.0;             ///< requested time step of a time-dependent input
  bool operator==(const InputStamp&) const = default;
};

/** The requested time if the input depends on time. */
inline double timeOf(vtkInformation* input)
{
  using vtkSDDP = vtkStreamingDemandDrivenPipeline;
  const bool hasTime = input->Has(vtkSDDP::TIME_STEPS()) || input->Has(vtkSDDP::TIME_RANGE());
  return hasTime && input->Has(vtkSDDP::UPDATE_TIME_STEP())
           ? input->Get(vtkSDDP::UPDATE_TIME_STEP())
           : 0.0;
}

/** The stamp of results of `filter` from its input, whose pipeline information is `info`. */
inline InputStamp stampOf(vtkAlgorithm& filter, PieceInput& input, vtkInformation* info)
{
  return { filter.GetMTime(), input.modifiedTime(), timeOf(info) };
}

} // namespace smg
