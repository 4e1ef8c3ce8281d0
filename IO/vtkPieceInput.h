// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <filesystem>

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
  /** Throws Error if nothing is connected, or a data set of several blocks. */
  PieceInput(vtkAlgorithm& consumer, int port);

  /**
   * Tells the pipeline, after a streamed request, that those to come are not streamed until they
   * say so again: else the last one would pass the guard of the reader on to a view.
   */
  ~PieceInput();

  PieceInput(const PieceInput&) = delete;
  PieceInput& operator=(const PieceInput&) = delete;

  /**
   * Brings the input to piece `piece` of `pieces`; `streamed` demands the real piece whatever its
   * size (see vtkStreamingMeshKeys), else it may be a preview. Throws InputFailed.
   */
  vtkDataObject* update(int piece, int pieces, bool streamed);

  /** Frees the data of the last piece, unless the producer has no way to make it again. */
  void release();

  /** The time at which something upstream was last modified, as far as the pipeline knows. */
  unsigned long long modifiedTime();

  /** What vtkStreamingMeshKeys::STREAM_FILE() says, after a piece was asked for; else empty. */
  std::filesystem::path streamFile() const;

  /** What vtkStreamingMeshKeys::PREVIEWED() says, as well. */
  bool isPreviewed() const;

  vtkAlgorithm& producer() const { return *this->Producer; }

  /** Whether the input is somebody's mesh set as data: it is the same for every piece. */
  bool isData() const;

private:
  vtkAlgorithm* Producer;
  int ProducerPort = 0;
  bool IsStreaming = false; ///< whether the last request was streamed
  vtkStreamingDemandDrivenPipeline* Executive;
};

} // namespace smg
