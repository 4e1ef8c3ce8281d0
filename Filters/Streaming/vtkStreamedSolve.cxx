// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Streaming/vtkStreamedSolve.h"

#include "IO/Files/PartialProgress.h"
#include "IO/vtkOrdinaryMesh.h"
#include "IO/vtkPieceStream.h"
#include "Solver/Storage/FileDescriptor.h"
#include "smg/Error.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>

namespace smg
{
namespace
{

/** The share of reading the input in the progress; the solve takes the rest. */
constexpr double PullShare = 0.25;
/** A conversion needs so much memory. */
constexpr std::int64_t LeastConversionMemory = std::int64_t(16) << 20;

} // namespace

void StreamedSolve::solve(
  PieceInput& input, const StreamedTask& task, const Pulling& pulling, Progress& progress)
{
  const auto make = [&](const std::filesystem::path& container, Progress& pulled)
  {
    PieceStream stream(input, pulling.pieces, task.columns());
    writeContainer(stream, container, true, pulled);
    return std::vector<std::string>();
  };
  this->solveOn(make, task, pulling, progress);
}

void StreamedSolve::solveWhole(
  vtkPointSet& mesh, const StreamedTask& task, const Pulling& pulling, Progress& progress)
{
  const auto make = [&](const std::filesystem::path& container, Progress& written)
  { return this->writeWhole(mesh, pulling, container, written); };
  this->solveOn(make, task, pulling, progress);
}

/** Removes the solution. Its checkpoint remains: nobody knows here whether the result has been
 * written. */
void StreamedSolve::release()
{
  this->Result.reset();
  this->Scratch.reset();
  this->VertexOfPoint.clear();
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

void StreamedSolve::solveOn(
  const MakeMesh& make, const StreamedTask& task, const Pulling& pulling, Progress& progress)
{
  try
  {
    this->discard();
    task.check();
    const auto start = std::chrono::steady_clock::now();
    this->Scratch = std::make_unique<ScratchFolder>(pulling.scratch, pulling.scratchLimit);
    const std::filesystem::path container = *this->Scratch / "mesh.vsm";
    const ProgressFunction whole = [&progress](double done)
    {
      progress.update(done);
      return true;
    };
    Progress made(partOf(whole, 0.0, PullShare));
    const std::vector<std::string> notes = make(container, made);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

    Report report;
    this->Result = task.solve(
      VsmReader(container), this->Scratch->path(), partOf(whole, PullShare, 1.0), report);
    FileDescriptor::removeClosed(container);
    report.seconds.convert = seconds.count();
    report.seconds.total += seconds.count();
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    this->Summary = SolveSummary::of(report, this->Result->columns());
  }
  catch (const std::exception& error)
  {
    this->fail(error.what());
  }
}

std::vector<std::string> StreamedSolve::writeWhole(vtkPointSet& mesh, const Pulling& pulling,
  const std::filesystem::path& container, Progress& progress)
{
  // Its own numbers would be taken for those of the points.
  const auto plain = vtkSmartPointer<vtkPointSet>::Take(mesh.NewInstance());
  plain->ShallowCopy(&mesh);
  plain->GetPointData()->RemoveArray(OriginalIdName);
  plain->GetCellData()->RemoveArray(OriginalCellIdName);
  ConversionOptions options;
  options.memoryLimit = std::max(pulling.memory, LeastConversionMemory);
  options.scratch = this->Scratch->path();
  options.threads = pulling.threads;
  options.codec = Codec::Lz4;
  options.progress = [&progress](double done)
  {
    progress.update(done);
    return true;
  };
  const ConversionReport report = writeOrdinaryMesh(*plain, container, options);

  this->VertexOfPoint.assign(static_cast<std::size_t>(mesh.GetNumberOfPoints()), -1);
  VsmReader reader(container);
  constexpr std::int64_t Chunk = 65536;
  Column numbers;
  for (std::int64_t first = 0; first < report.vertices; first += Chunk)
  {
    const std::int64_t count = std::min(Chunk, report.vertices - first);
    reader.readVertexColumn(OriginalIdName, first, count, numbers);
    std::int64_t vertex = first;
    for (const std::int64_t point : numbers.as<std::int64_t>())
    {
      this->VertexOfPoint[static_cast<std::size_t>(point)] = vertex++;
    }
  }
  return report.notes;
}

} // namespace smg
