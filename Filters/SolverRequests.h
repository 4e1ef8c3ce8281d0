// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/vtkStreamingSolver.h"

#include "Filters/Pieces/CoarserPreview.h"
#include "Filters/Pieces/PieceRequest.h"
#include "Filters/RegionChain.h"
#include "Filters/Tasks/PreviewErrorEstimate.h"
#include "Filters/Tasks/SolutionExchange.h"
#include "Filters/Tasks/SolveEstimate.h"
#include "Filters/Tasks/StreamedSolve.h"
#include "Filters/Tasks/WarnOnce.h"
#include "IO/Vtk/Abort.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/FieldMarks.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Error.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
    const smg::PieceRequest& request, vtkInformation* inputInfo, vtkInformation* outputInfo)
  {
    smg::PieceInput input(this->Self, 0);
    smg::SolutionExchange exchange(this->partners(request, input, inputInfo));
    this->checkRanges(exchange.isServer());
    vtkSmartPointer<vtkPointSet> present;
    exchange.together([&] { present = smg::fetchPiece(input, request, exchange); });
    if (exchange.isServer())
    {
      this->Unused.warn(this->Self.UnusedProperty());
    }
    const bool isOrdinary =
      !exchange.isParallel() && this->fetchWhole(input, request, inputInfo, present);
    if (isOrdinary && request.Piece > 0)
    {
      return; // piece 0 is all of it
    }
    // In memory, filters work on triangles and tetrahedra only. An ordinary mesh is solved on in
    // the same way whoever asks.
    const bool isWhole = isOrdinary || (request.Pieces == 1 && !exchange.isParallel());
    const bool isForMemory = exchange.decide(
      (isOrdinary || !request.IsStreamed) && exchange.isServer() &&
      !(isOrdinary && !smg::hasSimplices(*present)) && this->Self.IsForMemory(*present, isWhole));
    const bool isForProcesses =
      !isForMemory && this->isForProcesses(request, input, inputInfo, *present, exchange);
    std::vector<double> values;
    if (isForProcesses)
    {
      this->solveInProcesses(*present, values);
      this->Pieces.setStamp(request, smg::stampOf(this->Self, input, inputInfo));
    }
    else if (exchange.isServer())
    {
      this->solve(input, inputInfo, present, isOrdinary,
        !exchange.isParallel() && this->asksForWhole(input, request),
        isForMemory ? &values : nullptr);
    }
    this->Summary = this->inPanelWords(std::move(this->Summary));
    this->Summary.isCancelled = !this->Summary.error.empty() && smg::isAborted(this->Self);
    // With the distributed engine every process has a summary, and if one has failed, all have.
    exchange.share(this->Summary, exchange.firstOf(isForProcesses && !this->Summary.error.empty()));
    this->check(exchange.isServer());
    if (!request.IsStreamed)
    {
      this->Shown = this->Summary;
    }
    const bool isOutOfCore = !isForMemory && !isForProcesses;
    if (isOutOfCore && !isOrdinary)
    {
      this->fetch(input, request, exchange, present, values);
    }
    else if (isOutOfCore)
    {
      values = this->Streamed.valuesOfPoints();
      if (!values.empty() && static_cast<std::int64_t>(values.size()) !=
                               present->GetNumberOfPoints() * this->Summary.columns)
      {
        throw smg::Error("The input has other points than when it was solved on: apply again.");
      }
    }
    exchange.together(
      [&]
      {
        if (isForMemory && !exchange.isServer() && present->GetNumberOfPoints() > 0)
        {
          throw smg::Error("The input is a preview in process 0 and has points in another process, "
                           "too: all of a preview must be in process 0.");
        }
        this->deliver(*present, values, *vtkPointSet::GetData(outputInfo));
      });
    this->Shared.noteAnswer(request, smg::stampOf(this->Self, input, inputInfo));
  }

  /** Throws Error, in all processes alike, if a property is out of its range. */
  void checkRanges(bool isServer)
  {
    try
    {
      this->Self.CheckRanges();
    }
    catch (const smg::Error& error)
    {
      this->Summary = smg::SolveSummary::failed(error.what());
      this->check(isServer);
    }
  }

  /** Whether to solve on the preview that is shown. */
  bool isForPreview()
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

  /** Whether the mesh is to be solved on as one piece, since it is in memory as a whole. */
  bool asksForWhole(const smg::PieceInput& input, const smg::PieceRequest& request) const
  {
    const bool isWhole = request.Pieces == 1 && !request.IsStreamed && !input.isPreviewed();
    return this->Self.NumberOfPieces == 0 && (isWhole || input.isInMemory());
  }

  /** Brings all of an ordinary mesh, which is no piece of a mesh stream; returns whether it is one.
   * What is not for the memory is solved on as on a file. */
  bool fetchWhole(smg::PieceInput& input, const smg::PieceRequest& request,
    vtkInformation* inputInfo, vtkSmartPointer<vtkPointSet>& present)
  {
    // A piece may look like that of a stream where the whole does not.
    const bool isOrdinary = smg::lacksStreamNumbering(*present);
    const bool mayBe =
      isOrdinary || (this->asksForWhole(input, request) &&
                      !(this->StreamStamp == smg::stampOf(this->Self, input, inputInfo)));
    if (smg::isPreview(*present) || !mayBe || request.Pieces == 1)
    {
      const bool isWhole = isOrdinary && !smg::isPreview(*present);
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
    present = whole;
    if (isOrdinary || smg::lacksStreamNumbering(*whole))
    {
      return true;
    }
    present = vtkPointSet::SafeDownCast(request.update(input));
    this->StreamStamp = smg::stampOf(this->Self, input, inputInfo);
    return false;
  }

  /** The processes that process the request collectively; nullptr: this process alone. */
  vtkMultiProcessController* partners(
    const smg::PieceRequest& request, smg::PieceInput& input, vtkInformation* inputInfo)
  {
    const bool isServer = smg::SolutionExchange(this->Self.Controller).isServer();
    const smg::InputStamp stamp = smg::stampOf(this->Self, input, inputInfo);
    return this->Shared.isShared(request, stamp, isServer) ? this->Self.Controller : nullptr;
  }

  /** Solves in memory if there are values to fill, otherwise out of core. */
  void solve(smg::PieceInput& input, vtkInformation* inputInfo,
    vtkSmartPointer<vtkPointSet>& present, bool isOrdinary, bool asWhole,
    std::vector<double>* values)
  {
    if (values)
    {
      const vtkSmartPointer<vtkPointSet> shown = present;
      present = this->Self.MeshInMemory(*shown);
      this->Streamed.keepOnlyFor(smg::stampOf(this->Self, input, inputInfo));
      this->Summary = this->solveInMemory(*present, *values);
      if (present != shown && this->Summary.error.empty())
      {
        this->Self.SpreadValues(*shown, this->Summary.columns, *values);
      }
      present = shown;
      return;
    }
    this->solveOutOfCore(input, inputInfo, *present, isOrdinary, asWhole);
    this->Summary = this->Streamed.summary();
    if (smg::isPreview(*present) || input.isPreviewed())
    {
      this->Summary.fullPoints = this->Summary.vertices;
    }
  }

  /** Whether the processes solve together on their pieces, or have done so for this request. */
  bool isForProcesses(const smg::PieceRequest& request, smg::PieceInput& input,
    vtkInformation* inputInfo, vtkPointSet& present, smg::SolutionExchange& exchange)
  {
    if (!request.IsStreamed &&
        exchange.areAll(this->Pieces.isFor(request, smg::stampOf(this->Self, input, inputInfo))))
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
    return this->Self.IsForProcesses(present, isAlone);
  }

  /** Solves on the pieces of all processes unless there is a solution for this one; `values`: of
   * its points. */
  void solveInProcesses(vtkPointSet& present, std::vector<double>& values)
  {
    try
    {
      if (this->Pieces.isEmpty())
      {
        const smg::SolveSummary summary =
          this->Self.SolveInProcesses(present, smg::progressOf(this->Self), values);
        this->Pieces.hold(summary, values);
        this->warn(summary);
      }
      this->Summary = this->Pieces.summary();
      values = this->Pieces.values();
    }
    catch (const std::exception& error)
    {
      this->Summary = this->failed(error);
    }
  }

  /** Solves out of core unless there is a solution for this input. */
  void solveOutOfCore(smg::PieceInput& input, vtkInformation* inputInfo, vtkPointSet& present,
    bool isOrdinary, bool asWhole)
  {
    if (this->Streamed.isFor(smg::stampOf(this->Self, input, inputInfo)))
    {
      return;
    }
    try
    {
      smg::StreamedSolve::PieceReading reading;
      reading.pieces = smg::PieceCount::within(
        this->Self.NumberOfPieces, std::int64_t(this->Self.MemoryLimit) << 20);
      if (asWhole)
      {
        reading.pieces.given = 1;
      }
      reading.scratch = this->Self.ScratchDirectory ? this->Self.ScratchDirectory : "";
      reading.scratchLimit = std::int64_t(this->Self.ScratchLimit) << 20;
      reading.memory = std::int64_t(this->Self.MemoryLimit) << 20;
      reading.threads = this->Self.NumberOfThreads;
      smg::Progress progress(smg::progressOf(this->Self));
      const std::unique_ptr<smg::StreamedTask> task = this->Self.MakeTask(present);
      const smg::StreamFile file = smg::unchangedFile(this->Self, task->columns());
      if (!file.path.empty())
      {
        this->Streamed.solveFile(file.path, file.fingerprint, *task, reading, progress);
      }
      else
      {
        isOrdinary ? this->Streamed.solveWhole(present, *task, reading, progress)
                   : this->Streamed.solve(input, *task, reading, progress);
      }
    }
    catch (const std::exception& error)
    {
      this->Streamed.fail(this->Self.InPanelWords(error.what()));
    }
    // Requesting pieces may itself have updated modification times of the pipeline.
    this->Streamed.setStamp(smg::stampOf(this->Self, input, inputInfo));
    this->warn(this->Streamed.summary());
  }

  smg::SolveSummary solveInMemory(vtkPointSet& input, std::vector<double>& values)
  {
    if (smg::isPreview(input) && input.GetNumberOfCells() == 0)
    {
      return this->summaryOfNothing(); // of a preview that is in another process
    }
    try
    {
      const smg::ProgressFunction progress = smg::progressOf(this->Self);
      const auto solveCoarser = [&](vtkPointSet& mesh, std::vector<double>& found)
      { return this->Self.MakeCoarserTask(mesh)->solveInMemory(mesh, progress, found).columns; };
      std::optional<smg::PreviewErrorEstimate> previewError;
      if (smg::isPreview(input))
      {
        previewError.emplace(input, this->Coarser, solveCoarser);
      }
      smg::SolveSummary summary =
        this->Self.MakeTask(input)->solveInMemory(input, progress, values);
      summary.fullPoints = smg::pointsBehind(input);
      summary.previewPoints = summary.fullPoints > 0 ? input.GetNumberOfPoints() : 0;
      if (previewError)
      {
        summary.previewError =
          previewError->of(values, summary.columns, this->Self.ComparedColumns(summary.columns));
      }
      this->warn(summary);
      return summary;
    }
    catch (const std::exception& error)
    {
      return this->failed(error);
    }
  }

  /** For a piece without points: the last summary is kept. */
  smg::SolveSummary summaryOfNothing() const
  {
    smg::SolveSummary summary = this->Summary;
    summary.error.clear();
    summary.columns = 3; // so many at most, of no points
    summary.converged = summary.converged || summary.report.empty();
    return summary;
  }

  /** The failure of a solve, which process 0 reports for all. */
  class ReportedByServer : public smg::InputFailed
  {
  public:
    using InputFailed::InputFailed;
  };

  /** Throws Error if there is no solution. */
  void check(bool isServer) const
  {
    if (this->Summary.error.empty())
    {
      return;
    }
    if (this->Summary.isCancelled)
    {
      throw smg::Cancelled();
    }
    if (!isServer)
    {
      throw ReportedByServer(this->Summary.error);
    }
    throw smg::Error(this->Summary.error);
  }

  /** Warns, in process 0, of a solve that did not converge. */
  void warn(const smg::SolveSummary& summary) const
  {
    if (smg::SolutionExchange(this->Self.Controller).isServer())
    {
      smg::warnOf(this->Self, this->inPanelWords(summary), this->Self.IsToConverge());
    }
  }

  /** Fetches the values at the points of the requested piece, which `present` then holds again. */
  void fetch(smg::PieceInput& input, const smg::PieceRequest& request,
    smg::SolutionExchange& exchange, vtkSmartPointer<vtkPointSet>& present,
    std::vector<double>& values) const
  {
    std::vector<std::int64_t> ids;
    exchange.together(
      [&]
      {
        if (!exchange.isParallel())
        {
          present = smg::fetchPiece(input, request, exchange);
        }
        if (present->GetNumberOfPoints() > 0)
        {
          ids = smg::globalIdsOf(*present, "The input");
        }
      });
    exchange.together(
      [&] { values = exchange.values(ids, this->Summary.columns, this->Streamed.solution()); });
  }

  void deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) const
  {
    this->Self.Deliver(piece, values, output);
    vtkNew<vtkStringArray> report;
    report->SetName("Report");
    report->InsertNextValue(this->Summary.report);
    smg::addFieldArray(output, *report);
  }

  /** Before a request, which may fail before it comes to a solve. */
  void forgetFailure()
  {
    this->Summary.error.clear();
    this->Summary.isCancelled = false;
  }

  /** Whether the last output is up to date with the pipeline. */
  bool isUpToDate() const { return this->Failures.isCurrent(this->Self); }

  /** The failure of a solve, in the words of panels. */
  smg::SolveSummary failed(const std::exception& error) const
  {
    return smg::SolveSummary::failed(this->Self.InPanelWords(error.what()));
  }

  /** The same for what a solve has to say. */
  smg::SolveSummary inPanelWords(smg::SolveSummary summary) const
  {
    summary.error = this->Self.InPanelWords(summary.error);
    summary.notes = this->Self.InPanelWords(summary.notes);
    for (std::string& warning : summary.warnings)
    {
      warning = this->Self.InPanelWords(warning);
    }
    return summary;
  }

  vtkStreamingSolver& Self;
  smg::Failures Failures;
  smg::StreamedSolve Streamed;
  smg::KeptCoarserPreview Coarser;
  smg::InputStamp StreamStamp; ///< of an input that as a whole is a mesh stream
  smg::PieceSolve Pieces;
  smg::SolveSummary Summary;     ///< of the last output
  smg::SolveSummary Shown;       ///< of the last one that was not streamed
  std::string Outcome, Estimate; ///< storage of the strings returned by GetOutcome(), GetEstimate()
  smg::SharedRequest Shared;
  smg::WarnOnce Unused; ///< of a property that has no effect
};
