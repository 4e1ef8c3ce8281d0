// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/SolverInternals.h"

#include "Filters/Tasks/PreviewErrorEstimate.h"
#include "IO/Vtk/Abort.h"
#include "IO/Vtk/FieldMarks.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Error.h"

#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <memory>
#include <optional>
#include <utility>

void vtkStreamingSolver::Internals::answer(
  const smg::PieceRequest& request, vtkInformation* inputInfo, vtkInformation* outputInfo)
{
  smg::PieceInput input(this->Self, 0);
  smg::SolutionExchange exchange(this->partners(request, input, inputInfo));
  this->checkRanges(exchange.isServer());
  Inquiry inquiry{ request, input, inputInfo, exchange, {} };
  exchange.together([&] { inquiry.present = smg::fetchPiece(input, request, exchange); });
  if (exchange.isServer())
  {
    this->Unused.warn(this->Self.UnusedProperty());
  }
  const smg::Route route = this->chooseRoute(inquiry);
  if (route == smg::Route::Nothing)
  {
    return;
  }
  std::vector<double> values;
  this->solve(route, inquiry, values);
  if (!request.IsStreamed)
  {
    this->Shown = this->Summary;
  }
  if (route == smg::Route::OrdinaryOnDisk)
  {
    values = this->valuesOfOrdinary(*inquiry.present);
  }
  else if (route == smg::Route::StreamedFile || route == smg::Route::StreamedPieces)
  {
    this->fetchValues(inquiry, values);
  }
  const bool isInMemory =
    route == smg::Route::PreviewInMemory || route == smg::Route::WholeInMemory;
  exchange.together(
    [&]
    {
      if (isInMemory && !exchange.isServer() && inquiry.present->GetNumberOfPoints() > 0)
      {
        throw smg::Error("The input is a preview in process 0 and has points in another process, "
                         "too: all of a preview must be in process 0.");
      }
      this->deliver(inquiry, values, *vtkPointSet::GetData(outputInfo));
    });
  this->Shared.noteAnswer(request, this->stampOf(inquiry));
}

smg::InputStamp vtkStreamingSolver::Internals::stampOf(const Inquiry& inquiry) const
{
  return smg::stampOf(this->Self, inquiry.input, inquiry.inputInfo);
}

/** Throws Error, in all processes alike, if a property is out of its range. */
void vtkStreamingSolver::Internals::checkRanges(bool isServer)
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

/** Solves, unless there is a solution; `values` are those at the points of the input, if they are
 * in memory. Throws Error in all processes if there is no solution. */
void vtkStreamingSolver::Internals::solve(
  smg::Route route, Inquiry& inquiry, std::vector<double>& values)
{
  const bool isOnProcesses = route == smg::Route::OnProcesses;
  const bool isServer = inquiry.exchange.isServer();
  if (isOnProcesses)
  {
    this->solveOnProcesses(inquiry, values);
  }
  else if (isServer && (route == smg::Route::PreviewInMemory || route == smg::Route::WholeInMemory))
  {
    this->solveInMemory(inquiry, values);
  }
  else if (isServer)
  {
    this->solveOutOfCore(route, inquiry);
  }
  this->Summary = this->inPanelWords(std::move(this->Summary));
  this->Summary.isCancelled = !this->Summary.error.empty() && smg::isAborted(this->Self);
  // With the distributed engine every process has a summary, and if one has failed, all have.
  inquiry.exchange.share(
    this->Summary, inquiry.exchange.firstOf(isOnProcesses && !this->Summary.error.empty()));
  this->check(isServer);
}

void vtkStreamingSolver::Internals::solveOnProcesses(
  const Inquiry& inquiry, std::vector<double>& values)
{
  try
  {
    if (this->Pieces.isEmpty())
    {
      const smg::SolveSummary summary =
        this->Self.SolveInProcesses(*inquiry.present, smg::progressOf(this->Self), values);
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
  this->Pieces.setStamp(inquiry.request, this->stampOf(inquiry));
}

void vtkStreamingSolver::Internals::solveInMemory(Inquiry& inquiry, std::vector<double>& values)
{
  const vtkSmartPointer<vtkPointSet> mesh = this->Self.MeshInMemory(*inquiry.present);
  this->Streamed.keepOnlyFor(this->stampOf(inquiry));
  this->Summary = this->solveInMemory(*mesh, values);
  if (mesh != inquiry.present && this->Summary.error.empty())
  {
    this->Self.SpreadValues(*inquiry.present, this->Summary.columns, values);
  }
}

smg::SolveSummary vtkStreamingSolver::Internals::solveInMemory(
  vtkPointSet& mesh, std::vector<double>& values)
{
  if (smg::isPreview(mesh) && mesh.GetNumberOfCells() == 0)
  {
    return this->summaryOfNothing(); // of a preview that is in another process
  }
  try
  {
    const smg::ProgressFunction progress = smg::progressOf(this->Self);
    const auto solveCoarser = [&](vtkPointSet& coarser, std::vector<double>& found) {
      return this->Self.MakeCoarserTask(coarser)->solveInMemory(coarser, progress, found).columns;
    };
    std::optional<smg::PreviewErrorEstimate> previewError;
    if (smg::isPreview(mesh))
    {
      previewError.emplace(mesh, this->Coarser, solveCoarser);
    }
    smg::SolveSummary summary = this->Self.MakeTask(mesh)->solveInMemory(mesh, progress, values);
    summary.fullPoints = smg::pointsBehind(mesh);
    summary.previewPoints = summary.fullPoints > 0 ? mesh.GetNumberOfPoints() : 0;
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

void vtkStreamingSolver::Internals::solveOutOfCore(smg::Route route, const Inquiry& inquiry)
{
  if (!this->Streamed.isFor(this->stampOf(inquiry)))
  {
    try
    {
      const smg::StreamedSolve::PieceReading reading = this->reading(inquiry);
      smg::Progress progress(smg::progressOf(this->Self));
      const std::unique_ptr<smg::JobTask> task =
        this->Task ? std::move(this->Task) : this->Self.MakeTask(*inquiry.present);
      if (route == smg::Route::StreamedFile)
      {
        this->Streamed.solveFile(this->File.path, this->File.fingerprint, *task, reading, progress);
      }
      else if (route == smg::Route::OrdinaryOnDisk)
      {
        this->Streamed.solveWhole(*inquiry.present, *task, reading, progress);
      }
      else
      {
        this->Streamed.solve(inquiry.input, *task, reading, progress);
      }
    }
    catch (const std::exception& error)
    {
      this->Streamed.fail(this->Self.InPanelWords(error.what()));
    }
    // Requesting pieces may itself have updated modification times of the pipeline.
    this->Streamed.setStamp(this->stampOf(inquiry));
    this->warn(this->Streamed.summary());
  }
  this->Summary = this->Streamed.summary();
  if (smg::isPreview(*inquiry.present) || inquiry.input.isPreviewed())
  {
    this->Summary.fullPoints = this->Summary.facts.vertices;
  }
}

/** Fetches the values at the points of the requested piece, which the inquiry then holds again. */
void vtkStreamingSolver::Internals::fetchValues(Inquiry& inquiry, std::vector<double>& values) const
{
  smg::SolutionExchange& exchange = inquiry.exchange;
  std::vector<std::int64_t> ids;
  exchange.together(
    [&]
    {
      if (!exchange.isParallel())
      {
        inquiry.present = smg::fetchPiece(inquiry.input, inquiry.request, exchange);
      }
      if (inquiry.present->GetNumberOfPoints() > 0)
      {
        ids = smg::globalIdsOf(*inquiry.present, "The input");
      }
    });
  exchange.together(
    [&] { values = exchange.values(ids, this->Summary.columns, this->Streamed.solution()); });
}

std::vector<double> vtkStreamingSolver::Internals::valuesOfOrdinary(vtkPointSet& mesh)
{
  std::vector<double> values = this->Streamed.valuesOfPoints();
  if (!values.empty() &&
      static_cast<std::int64_t>(values.size()) != mesh.GetNumberOfPoints() * this->Summary.columns)
  {
    throw smg::Error("The input has other points than when it was solved on: apply again.");
  }
  return values;
}

void vtkStreamingSolver::Internals::deliver(
  const Inquiry& inquiry, const std::vector<double>& values, vtkPointSet& output) const
{
  this->Self.Deliver(*inquiry.present, values, output);
  vtkNew<vtkStringArray> report;
  report->SetName("Report");
  report->InsertNextValue(this->Summary.report);
  smg::addFieldArray(output, *report);
}

/** For a piece without points: the last summary is kept. */
smg::SolveSummary vtkStreamingSolver::Internals::summaryOfNothing() const
{
  smg::SolveSummary summary = this->Summary;
  summary.error.clear();
  summary.columns = 3; // so many at most, of no points
  summary.facts.converged = summary.facts.converged || summary.report.empty();
  return summary;
}

/** Throws Error if there is no solution; process 0 reports it for all. */
void vtkStreamingSolver::Internals::check(bool isServer) const
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
    throw smg::InputFailed(this->Summary.error);
  }
  throw smg::Error(this->Summary.error);
}

/** Warns, in process 0, of a solve that did not converge. */
void vtkStreamingSolver::Internals::warn(const smg::SolveSummary& summary) const
{
  if (smg::SolutionExchange(this->Self.Controller).isServer())
  {
    smg::warnOf(this->Self, this->inPanelWords(summary), this->Self.IsToConverge());
  }
}

void vtkStreamingSolver::Internals::forgetFailure()
{
  this->Summary.error.clear();
  this->Summary.isCancelled = false;
}

/** The failure of a solve, in the words of panels. */
smg::SolveSummary vtkStreamingSolver::Internals::failed(const std::exception& error) const
{
  return smg::SolveSummary::failed(this->Self.InPanelWords(error.what()));
}

/** The same for what a solve has to say. */
smg::SolveSummary vtkStreamingSolver::Internals::inPanelWords(smg::SolveSummary summary) const
{
  summary.error = this->Self.InPanelWords(summary.error);
  summary.notes = this->Self.InPanelWords(summary.notes);
  for (std::string& warning : summary.facts.warnings)
  {
    warning = this->Self.InPanelWords(warning);
  }
  return summary;
}
