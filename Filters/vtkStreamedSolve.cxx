// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamedSolve.h"

#include "IO/Container/VsmReader.h"
#include "IO/Conversion/PartialProgress.h"
#include "IO/vtkPieceStream.h"
#include "Solver/Core/Error.h"
#include "Solver/Storage/ScratchFolder.h"

#include <algorithm>
#include <chrono>
#include <cmath>

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

/** Throws Error about what is wrong whatever the input is, so that it is not pulled in vain. */
void check(const StreamedSolveSettings& settings)
{
  ColumnProblem::check(settings.arrays);
  checkOptions(settings.options);
  if (!std::isfinite(settings.screening))
  {
    throw Error("The screening is not a finite number: use one that is at least 0.");
  }
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
  check(settings);
  const auto start = std::chrono::steady_clock::now();
  const ScratchFolder scratch(settings.options.scratch);
  const std::filesystem::path container = scratch.path() / "mesh.vsm";
  const ProgressFunction whole = [&progress](double done)
  {
    progress.update(done);
    return true;
  };
  Progress pulling(partOf(whole, 0.0, PullShare));
  {
    PieceStream stream(input, settings.pieces, columnsOf(settings.arrays));
    writeContainer(stream, container, true, pulling);
  }
  const std::chrono::duration<double> pulled = std::chrono::steady_clock::now() - start;

  const VsmReader reader(container);
  ColumnProblem problem(reader.info(), settings.arrays, settings.weights, settings.screening);
  SolveOptions options = settings.options;
  options.progress = partOf(whole, PullShare, 1.0);
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
  this->Summary.residual = report.residual();
  this->Summary.cycles = report.cycles;
  this->Summary.passes = report.passes;
  this->Summary.converged = report.converged;
  this->Summary.peakMemory = report.pool_bytes_peak;
}

} // namespace smg
