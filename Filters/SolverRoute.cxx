// SPDX-License-Identifier: BSD-3-Clause
/** @file
 * By which route a request is answered: chooseRoute(), with the questions that decide it. Routes on
 * several processes are chosen collectively, the same in all of them but for what only process 0
 * does out of core.
 */
#include "Filters/SolverInternals.h"

#include "Filters/Tasks/SolveEstimate.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceCells.h"
#include "smg/Error.h"

#include "vtkMultiProcessController.h"

#include <optional>

namespace
{

/** Whether the mesh is to be solved on as one piece, since it is in memory as a whole. */
bool asksForWhole(const smg::PieceInput& input, const smg::PieceRequest& request, int givenPieces)
{
  const bool isWhole = request.Pieces == 1 && !request.IsStreamed && !input.isPreviewed();
  return givenPieces == 0 && (isWhole || input.isInMemory());
}

} // namespace

smg::Route vtkStreamingSolver::Internals::chooseRoute(Inquiry& inquiry)
{
  smg::SolutionExchange& exchange = inquiry.exchange;
  const bool isOrdinary = !exchange.isParallel() && this->fetchWhole(inquiry);
  if (isOrdinary && inquiry.request.Piece > 0)
  {
    return smg::Route::Nothing;
  }
  if (exchange.decide(exchange.isServer() && this->isForMemory(inquiry, isOrdinary)))
  {
    return smg::isPreview(*inquiry.present) ? smg::Route::PreviewInMemory
                                            : smg::Route::WholeInMemory;
  }
  if (this->isForProcesses(inquiry))
  {
    return smg::Route::OnProcesses;
  }
  if (isOrdinary)
  {
    return smg::Route::OrdinaryOnDisk;
  }
  return exchange.isServer() && this->isForFile(inquiry) ? smg::Route::StreamedFile
                                                         : smg::Route::StreamedPieces;
}

/** Brings all of an ordinary mesh, which is no piece of a mesh stream; returns whether it is one.
 * What is not for the memory is solved on as on a file. */
bool vtkStreamingSolver::Internals::fetchWhole(Inquiry& inquiry)
{
  const smg::PieceRequest& request = inquiry.request;
  smg::PieceInput& input = inquiry.input;
  // A piece may look like that of a stream where the whole does not.
  const bool isOrdinary = smg::lacksStreamNumbering(*inquiry.present);
  const bool mayBe = isOrdinary || (asksForWhole(input, request, this->Self.NumberOfPieces) &&
                                     !(this->StreamStamp == this->stampOf(inquiry)));
  if (smg::isPreview(*inquiry.present) || !mayBe || request.Pieces == 1)
  {
    const bool isWhole = isOrdinary && !smg::isPreview(*inquiry.present);
    if (isWhole && !request.IsStreamed)
    {
      input.requireWhole();
    }
    return isWhole;
  }
  vtkPointSet* whole = vtkPointSet::SafeDownCast(input.update(0, 1, false));
  if (smg::isPreview(*whole))
  {
    return false; // a filter before this one has lost what belongs to the pieces of the mesh
  }
  input.requireWhole();
  inquiry.present = whole;
  if (isOrdinary || smg::lacksStreamNumbering(*whole))
  {
    return true;
  }
  inquiry.present = vtkPointSet::SafeDownCast(request.update(input));
  this->StreamStamp = this->stampOf(inquiry);
  return false;
}

/** Whether to solve in memory, where filters work on triangles and tetrahedra only. An ordinary
 * mesh is solved on in the same way whoever asks. */
bool vtkStreamingSolver::Internals::isForMemory(const Inquiry& inquiry, bool isOrdinary)
{
  const smg::PieceRequest& request = inquiry.request;
  const bool isWhole = isOrdinary || (request.Pieces == 1 && !inquiry.exchange.isParallel());
  return (isOrdinary ? smg::hasSimplices(*inquiry.present) : !request.IsStreamed) &&
         this->Self.IsForMemory(*inquiry.present, isWhole);
}

bool vtkStreamingSolver::Internals::isForPreview()
{
  constexpr double Long = 20.0; // seconds
  if (this->Self.Solve != AUTOMATIC_SOLVE)
  {
    return this->Self.Solve == ON_PREVIEW;
  }
  smg::SolveOptions options;
  this->Self.FillOptions(options);
  const std::optional<double> seconds = smg::solveSeconds(
    this->Self, [this](vtkPointSet& input) { return this->Self.MakeEstimatedTask(input); },
    options);
  return !seconds || *seconds > Long;
}

/** Whether the processes solve together on their pieces, or have done so for this request. */
bool vtkStreamingSolver::Internals::isForProcesses(const Inquiry& inquiry)
{
  const smg::PieceRequest& request = inquiry.request;
  smg::SolutionExchange& exchange = inquiry.exchange;
  if (!request.IsStreamed && exchange.areAll(this->Pieces.isFor(request, this->stampOf(inquiry))))
  {
    return true;
  }
  if (!request.IsStreamed)
  {
    this->Pieces.release();
  }
  const bool isAlone =
    request.IsStreamed ||
    (!exchange.isParallel() && smg::SolutionExchange(this->Self.Controller).isParallel());
  return this->Self.IsForProcesses(*inquiry.present, isAlone);
}

/** Whether the reader's file has all that the task needs. If the task cannot be made, its solve
 * says why. */
bool vtkStreamingSolver::Internals::isForFile(const Inquiry& inquiry)
{
  if (this->Streamed.isFor(this->stampOf(inquiry)))
  {
    return !this->File.path.empty();
  }
  this->Task.reset();
  try
  {
    this->Task = this->Self.MakeTask(*inquiry.present);
    this->File = smg::unchangedFile(this->Self, this->Task->columns());
  }
  catch (const smg::Error&)
  {
    this->File = {};
  }
  return !this->File.path.empty();
}

/** The processes that process the request collectively; nullptr: this process alone. */
vtkMultiProcessController* vtkStreamingSolver::Internals::partners(
  const smg::PieceRequest& request, smg::PieceInput& input, vtkInformation* inputInfo)
{
  const bool isServer = smg::SolutionExchange(this->Self.Controller).isServer();
  const smg::InputStamp stamp = smg::stampOf(this->Self, input, inputInfo);
  return this->Shared.isShared(request, stamp, isServer) ? this->Self.Controller : nullptr;
}

smg::StreamedSolve::PieceReading vtkStreamingSolver::Internals::reading(
  const Inquiry& inquiry) const
{
  smg::StreamedSolve::PieceReading reading;
  reading.memory = std::int64_t(this->Self.MemoryLimit) << 20;
  reading.pieces = smg::PieceCount::within(this->Self.NumberOfPieces, reading.memory);
  if (!inquiry.exchange.isParallel() &&
      asksForWhole(inquiry.input, inquiry.request, this->Self.NumberOfPieces))
  {
    reading.pieces.given = 1;
  }
  reading.scratch = this->Self.ScratchDirectory;
  reading.scratchLimit = std::int64_t(this->Self.ScratchLimit) << 20;
  reading.threads = this->Self.GetNumberOfThreads();
  return reading;
}
