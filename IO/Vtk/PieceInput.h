// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include "vtkSmartPointer.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <exception>
#include <filesystem>
#include <optional>
#include <string>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkDataObject;
class vtkInformationStringKey;
class vtkPointSet;
class vtkStreamingDemandDrivenPipeline;

namespace smg
{

/** The name by which a filter is known to a user of ParaView, for messages: the words of its class,
 * as "Streaming Distance". */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::string nameInPipeline(vtkAlgorithm& filter);

/** The first connection of an input port of a VTK algorithm, from which the algorithm requests
 * pieces one at a time while it executes. Of a data set of several blocks, the single one with
 * cells is the input, for whichever piece: see meshOf(). */
class VTKSTREAMINGMULTIGRIDIO_EXPORT PieceInput
{
public:
  /** Throws Error if nothing is connected. */
  PieceInput(vtkAlgorithm& consumer, int port);
  /** An output of an algorithm, for a consumer that is no algorithm. */
  explicit PieceInput(vtkAlgorithmOutput& output);

  /** Resets the streamed request in the pipeline: otherwise a later request of a view would still
   * count as streamed and bypass the size limit of the reader. */
  ~PieceInput();

  PieceInput(const PieceInput&) = delete;
  PieceInput& operator=(const PieceInput&) = delete;

  /** Updates the input to piece `piece` of `pieces`. `streamed` requests the real piece of any size
   * (see vtkStreamingMeshKeys); otherwise it may be a preview. `ghostLevels`: layers of ghost cells
   * around the piece. Throws InputFailed, and Error if one of several blocks cannot be chosen. */
  vtkDataObject* update(int piece, int pieces, bool streamed, int ghostLevels = 0);

  /** The layers of ghost cells that the filters of others before the consumer may need for a piece:
   * one for each, as it may compute from the neighbours of a cell or point, whether it asks for
   * them itself or not. 0 if the input is one piece. */
  int ghostLevels(int pieces) const;

  /** Frees the data of the last piece, unless the producer cannot regenerate it. */
  void release();

  /** The last modification time of the upstream pipeline, as known to the executive. */
  unsigned long long modifiedTime();

  /** The value of vtkStreamingMeshKeys::STREAM_FILE(), after a piece was requested; else empty. */
  std::filesystem::path streamFile() const;

  /** What that file must have: vtkStreamingMeshKeys::STREAM_FINGERPRINT(). Empty: any. */
  std::string streamFingerprint() const;

  /** The information on the whole mesh, before a piece is requested, if its pieces are those of a
   * .vsm file; filters between may have changed them. Throws Error if that file is damaged. */
  std::optional<StreamInfo> meshInfo();

  /** The value of vtkStreamingMeshKeys::PREVIEWED(), after a piece was requested. */
  bool isPreviewed() const;

  /** Throws Error if isPreviewed(): a mesh that nothing marks as a preview is then made of one, and
   * only looks like a mesh of its own. */
  void requireWhole() const;

  /** Whether a reader of this library says, after a piece was requested, that the mesh is shown as
   * a whole. Then it is to be requested as one: filters between may compute something of all of the
   * data that they have, or renumber it. */
  bool isInMemory() const;

  /** Says that the user has not chosen the number of pieces: messages do not count them. */
  void hidePieces() { this->NamesPieces = false; }
  /** What a message says of a piece: "Piece 3 of 64 of the input"; "The input" where it comes as a
   * whole, and "The input from Clip" where the user knows no pieces. */
  std::string placeOfPiece(int piece, int pieces) const;

  /** The name of the filter that delivers the pieces, for messages. */
  std::string producerName() const;

  /** Whether filters of others are before the consumer. */
  bool isFiltered() const;

  /** Whether the input is what a solver computes besides the mesh, as paths: all of it comes with
   * whichever streamed piece. */
  bool isBesideMesh() const;

  /** Says that two pieces have different values at a point of both. */
  void noteDifference() { this->Differs = true; }
  /** A note, if that was said, which names the filters of others before the consumer; else empty.
   */
  std::string noteOnBorders() const;

  /** Whether the input was set as a data object, or is a block, which is the same for every piece.
   */
  bool isData() const;

private:
  /** Has a reader convert its file if it has read only its beginning, so that what it says of the
   * mesh comes through the filters between before a piece is requested. */
  void learnMesh();
  std::string text(vtkInformationStringKey* key) const;

  vtkAlgorithm* Producer;
  int ProducerPort;
  bool NamesPieces = true;                     ///< whether messages count them
  bool Differs = false;                        ///< whether two pieces do at a point of both
  bool IsStreaming = false;                    ///< whether the last request was streamed
  int Exceptions = std::uncaught_exceptions(); ///< that are in flight while this is made
  vtkSmartPointer<vtkPointSet> Block; ///< of an input of several blocks, once it was requested
  vtkStreamingDemandDrivenPipeline* Executive;
};

} // namespace smg
