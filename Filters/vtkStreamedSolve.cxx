// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamedSolve.h"

#include "IO/Container/VsmReader.h"
#include "IO/vtkPieceStream.h"
#include "Solver/Storage/ScratchFolder.h"

#include <algorithm>
#include <chrono>

namespace smg
{
namespace
{

/** The share of the progress that pulling the input has; solving has the rest. */
constexpr double PullShare = 0.25;

/** The arrays that the problem needs, each once, and the marks of cells without weight. */
PieceColumns columnsOf(const ColumnProblemNames& names)
{
  PieceColumns columns;
  for (const std::string& name : { names.mask, names.values, names.source, names.guess })
  {
    if (!name.empty() &&
        std::find(columns.points.begin(), columns.points.end(), name) == columns.points.end())
    {
      columns.points.push_back(name);
    }
  }
  columns.cells.push_back(CellFlagsName);
  return columns;
}

/** A progress that counts for the part [begin, end] of another. */
Progress partOf(Progress& whole, double begin, double end)
{
  return Progress(
    [&whole, begin, end](double done)
    {
      whole.update(begin + (end - begin) * done);
      return true;
    });
}

} // namespace

void StreamedSolve::solve(
  PieceInput& input, const StreamedSolveSettings& settings, Progress& progress)
{
  try
  {
    this->Result.reset();
    this->pullAndSolve(input, settings, progress);
  }
  catch (const std::exception& error)
  {
    this->fail(error.what());
  }
}

void StreamedSolve::fail(const std::string& sentence)
{
  this->Result.reset();
  this->Summary = {};
  this->Summary.error = sentence;
}

void StreamedSolve::pullAndSolve(
  PieceInput& input, const StreamedSolveSettings& settings, Progress& progress)
{
  const auto start = std::chrono::steady_clock::now();
  const ScratchFolder scratch(settings.options.scratch);
  const std::filesystem::path container = scratch.path() / "mesh.vsm";
  Progress pulling = partOf(progress, 0.0, PullShare);
  {
    PieceStream stream(input, settings.pieces, columnsOf(settings.arrays));
    writeContainer(stream, container, true, pulling);
  }
  const std::chrono::duration<double> pulled = std::chrono::steady_clock::now() - start;

  const VsmReader reader(container);
  ColumnProblem problem(reader.info(), settings.arrays, settings.weights, settings.screening);
  SolveOptions options = settings.options;
  options.progress = [solving = partOf(progress, PullShare, 1.0)](double done) mutable
  {
    solving.update(done);
    return true;
  };
  this->Result = smg::solve(*reader.source(), problem, options);
  this->summarize(pulled.count());
}

void StreamedSolve::summarize(double secondsPulled)
{
  Report report = this->Result->report();
  report.seconds.convert = secondsPulled;
  report.seconds.total += secondsPulled;
  this->Summary = {};
  this->Summary.report = report.json();
  this->Summary.columns = this->Result->columns();
  this->Summary.residual = report.residuals.empty() ? 0.0 : report.residuals.back();
  this->Summary.cycles = report.cycles;
  this->Summary.passes = report.passes;
  this->Summary.converged = report.converged;
  this->Summary.peakMemory = report.pool_bytes_peak;
}

} // namespace smg
