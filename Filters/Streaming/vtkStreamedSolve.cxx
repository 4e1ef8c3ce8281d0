// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Streaming/vtkStreamedSolve.h"

#include "IO/Files/PartialProgress.h"
#include "Solver/Storage/FileDescriptor.h"
#include "smg/Error.h"

#include <chrono>

namespace smg
{
namespace
{

/** The share of reading the input in the progress; the solve takes the rest. */
constexpr double PullShare = 0.25;

} // namespace

void StreamedSolve::solve(
  PieceInput& input, const StreamedTask& task, const Pulling& pulling, Progress& progress)
{
  try
  {
    this->discard();
    this->pullAndSolve(input, task, pulling, progress);
  }
  catch (const std::exception& error)
  {
    this->fail(error.what());
  }
}

/** Removes the solution. Its checkpoint remains: nobody knows here whether the result has been
 * written. */
void StreamedSolve::release()
{
  this->Result.reset();
  this->Scratch.reset();
}

/** Removes the solution with its checkpoint: something else is wanted. */
void StreamedSolve::discard()
{
  if (this->Result)
  {
    this->Result->removeCheckpoint();
  }
  this->release();
}

void StreamedSolve::fail(const std::string& sentence)
{
  this->release();
  this->Summary = SolveSummary::failed(sentence);
}

void StreamedSolve::pullAndSolve(
  PieceInput& input, const StreamedTask& task, const Pulling& pulling, Progress& progress)
{
  task.check();
  const auto start = std::chrono::steady_clock::now();
  this->Scratch = std::make_unique<ScratchFolder>(pulling.scratch, pulling.scratchLimit);
  const std::filesystem::path container = *this->Scratch / "mesh.vsm";
  const ProgressFunction whole = [&progress](double done)
  {
    progress.update(done);
    return true;
  };
  Progress pullProgress(partOf(whole, 0.0, PullShare));
  {
    PieceStream stream(input, pulling.pieces, task.columns());
    writeContainer(stream, container, true, pullProgress);
  }
  const std::chrono::duration<double> pulled = std::chrono::steady_clock::now() - start;

  Report report;
  this->Result =
    task.solve(VsmReader(container), this->Scratch->path(), partOf(whole, PullShare, 1.0), report);
  FileDescriptor::removeClosed(container);
  report.seconds.convert = pulled.count();
  report.seconds.total += pulled.count();
  this->Summary = SolveSummary::of(report, this->Result->columns());
}

} // namespace smg
