// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/CoarserPreview.h"
#include "Filters/Pieces/PieceRequest.h"
#include "Filters/RegionChain.h"
#include "Filters/Tasks/JobTask.h"
#include "Filters/Tasks/SolutionExchange.h"
#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/StreamedSolve.h"
#include "Filters/Tasks/WarnOnce.h"
#include "Filters/vtkStreamingSolver.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/PieceInput.h"

#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

class vtkInformation;
class vtkMultiProcessController;

namespace smg
{

/** How a request is answered; docs/vtk.md says when, and what each costs. */
enum class Route : std::uint8_t
{
  Nothing,         ///< an ordinary mesh is all in piece 0, and this is another one
  PreviewInMemory, ///< solves on the preview that is shown
  WholeInMemory,   ///< solves on the whole mesh, in memory
  OnProcesses,     ///< solves on the pieces that all processes have
  OrdinaryOnDisk,  ///< solves on an ordinary mesh, sorted and written to a file
  StreamedFile,    ///< solves on the file of the reader
  StreamedPieces   ///< solves on the pieces of the input, written to a file
};

} // namespace smg

/** How the filter answers requests, and what it keeps between them. */
struct vtkStreamingSolver::Internals
{
  explicit Internals(vtkStreamingSolver& self)
    : Self(self)
    , Unused(self)
  {
  }

  /** Processes a request, with several processes collectively. Throws Error in all of them if one
   * fails. */
  void answer(
    const smg::PieceRequest& request, vtkInformation* inputInfo, vtkInformation* outputInfo);
  /** Whether to solve on the preview that is shown. */
  bool isForPreview();
  /** Before a request, which may fail before it comes to a solve. */
  void forgetFailure();
  /** Whether the last output is up to date with the pipeline. */
  bool isUpToDate() const { return this->Failures.isCurrent(this->Self); }

  vtkStreamingSolver& Self;
  smg::Failures Failures;
  smg::SolveSummary Summary;     ///< of the last output
  smg::SolveSummary Shown;       ///< of the last one that was not streamed
  std::string Outcome, Estimate; ///< storage of the strings returned by GetOutcome(), GetEstimate()

private:
  /** A request while it is answered, with the input of this process. */
  struct Inquiry
  {
    const smg::PieceRequest& request;
    smg::PieceInput& input;
    vtkInformation* inputInfo;
    smg::SolutionExchange& exchange;
    vtkSmartPointer<vtkPointSet> present; ///< what the input has delivered last
  };

  /** What the results for the input depend on. */
  smg::InputStamp stampOf(const Inquiry& inquiry) const;

  // SolverRoute.cxx
  smg::Route chooseRoute(Inquiry& inquiry);
  bool fetchWhole(Inquiry& inquiry);
  bool isForMemory(const Inquiry& inquiry, bool isOrdinary);
  bool isForProcesses(const Inquiry& inquiry);
  bool isForFile(const Inquiry& inquiry);
  vtkMultiProcessController* partners(
    const smg::PieceRequest& request, smg::PieceInput& input, vtkInformation* inputInfo);

  void checkRanges(bool isServer);
  void solve(smg::Route route, Inquiry& inquiry, std::vector<double>& values);
  void solveOnProcesses(const Inquiry& inquiry, std::vector<double>& values);
  void solveInMemory(Inquiry& inquiry, std::vector<double>& values);
  smg::SolveSummary solveInMemory(vtkPointSet& mesh, std::vector<double>& values);
  void solveOutOfCore(smg::Route route, const Inquiry& inquiry);
  smg::StreamedSolve::PieceReading reading(const Inquiry& inquiry) const;
  void fetchValues(Inquiry& inquiry, std::vector<double>& values) const;
  std::vector<double> valuesOfOrdinary(vtkPointSet& mesh);
  void deliver(
    const Inquiry& inquiry, const std::vector<double>& values, vtkPointSet& output) const;

  smg::SolveSummary summaryOfNothing() const;
  void check(bool isServer) const;
  void warn(const smg::SolveSummary& summary) const;
  smg::SolveSummary failed(const std::exception& error) const;
  smg::SolveSummary inPanelWords(smg::SolveSummary summary) const;

  smg::StreamedSolve Streamed;
  // Of isForFile(), for the solve that follows: the file of Route::StreamedFile, and the task,
  // which reads files and arrays when it is made.
  smg::StreamFile File;
  std::unique_ptr<smg::JobTask> Task;
  smg::KeptCoarserPreview Coarser;
  smg::InputStamp StreamStamp; ///< of an input that as a whole is a mesh stream
  smg::PieceSolve Pieces;
  smg::SharedRequest Shared;
  smg::WarnOnce Unused; ///< of a property that has no effect
};
