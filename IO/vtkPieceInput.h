// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

class vtkAlgorithm;
class vtkDataObject;
class vtkStreamingDemandDrivenPipeline;

namespace smg
{

/**
 * The first connection of an input port of a VTK algorithm, from which the algorithm pulls pieces,
 * one at a time, while it executes.
 */
class VTKSTREAMINGMULTIGRIDIO_EXPORT PieceInput
{
public:
  /** Throws Error if nothing is connected. */
  PieceInput(vtkAlgorithm& consumer, int port);

  /**
   * Brings the input to piece `piece` of `pieces`; `streamed` demands the real piece whatever its
   * size (see vtkStreamingMeshKeys), else it may be a preview. Throws Error if that fails.
   */
  vtkDataObject* update(int piece, int pieces, bool streamed);

  /** Frees the data of the last piece. */
  void release();

  /** Tells the pipeline that the requests to come are not streamed until they say so again. */
  void endStreaming();

  /** The time at which something upstream was last modified, as far as the pipeline knows. */
  unsigned long long modifiedTime();

  /** Brings the pipeline information, and so modifiedTime(), up to date. Throws Error. */
  void updateInformation();

  vtkAlgorithm& producer() const { return *this->Producer; }

private:
  vtkAlgorithm* Producer;
  int ProducerPort = 0;
  vtkStreamingDemandDrivenPipeline* Executive;
};

} // namespace smg
