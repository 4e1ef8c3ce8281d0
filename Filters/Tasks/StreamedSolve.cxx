// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/StreamedSolve.h"

#include "Filters/Tasks/SolveSummary.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceStream.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

namespace smg
{
namespace
{

/** The share of reading the input in the progress; the solve takes the rest. */
constexpr double ReadShare = 0.25;
/** Conversions, and the blocks of a file as they are written, need so much memory. */
constexpr std::int64_t MinConversionMemory = std::int64_t(16) << 20;

/** A folder whose files are in memory, as Linux has it. */
constexpr const char* FolderInMemory = "/dev/shm";

/** A folder for the scratch files of a solve on a mesh that VTK has in memory: there, too, if none
 * is given and they take at most half of the memory limit and a quarter of what is free. The mesh
 * is sorted and written in order; a solve has some hundred bytes a point. */
std::unique_ptr<ScratchFolder> folderFor(
  vtkPointSet& mesh, const StreamedSolve::PieceReading& reading)
{
  constexpr std::int64_t OfPoint = 400;
  const std::int64_t bytes = 4 * static_cast<std::int64_t>(mesh.GetActualMemorySize()) * 1024 +
                             OfPoint * mesh.GetNumberOfPoints();
  std::error_code absent;
  const std::filesystem::space_info space = std::filesystem::space(FolderInMemory, absent);
  if (reading.scratch.empty() && !absent && bytes <= reading.memory / 2 &&
      static_cast<std::uintmax_t>(bytes) <= space.available / 4)
  {
    try
    {
      return std::make_unique<ScratchFolder>(FolderInMemory, reading.scratchLimit);
    }
    catch (const Error&)
    {
      // Not writable: on the disk, then.
    }
  }
  return std::make_unique<ScratchFolder>(reading.scratch, reading.scratchLimit);
}

/** A progress function that cannot cancel by itself. */
ProgressFunction functionOf(Progress& progress)
{
  return [&progress](double done)
  {
    progress.update(done);
    return true;
  };
}

/** The mesh without what no column of a stream can be: the output has all arrays of the input. */
vtkSmartPointer<vtkPointSet> withoutTexts(vtkPointSet& mesh)
{
  vtkSmartPointer<vtkPointSet> copy = withoutOriginalNumbers(mesh);
  for (vtkFieldData* data : { static_cast<vtkFieldData*>(copy->GetPointData()),
         static_cast<vtkFieldData*>(copy->GetCellData()) })
  {
    for (int k = data->GetNumberOfArrays() - 1; k >= 0; --k)
    {
      vtkDataArray* const array = data->GetArray(k);
      if (!array || array->GetDataType() == VTK_BIT)
      {
        data->RemoveArray(k);
      }
    }
  }
  return copy;
}

/** Throws Error if one of these arrays is no array of numbers. */
void requireNumbers(vtkPointSet& mesh, const std::set<std::string>& names)
{
  for (const std::string& name : names)
  {
    for (vtkFieldData* data : { static_cast<vtkFieldData*>(mesh.GetPointData()),
           static_cast<vtkFieldData*>(mesh.GetCellData()) })
    {
      if (data->GetAbstractArray(name.c_str()) && !data->GetArray(name.c_str()))
      {
        throw Error("the array '" + name + "' is one of texts: one of numbers is needed");
      }
    }
  }
}

} // namespace

void StreamedSolve::solve(
  PieceInput& input, JobTask& task, const PieceReading& reading, Progress& progress)
{
  const auto make = [&](const std::filesystem::path& container, Progress& pulled, Report& notes)
  {
    PieceStream stream(input, reading.pieces, task.columns());
    writeContainer(stream, container, true, pulled);
    if (const std::string lacking = input.noteOnBorders(); !lacking.empty())
    {
      notes.warn(lacking);
    }
  };
  const auto folder = [&]
  { return std::make_unique<ScratchFolder>(reading.scratch, reading.scratchLimit); };
  this->solveOn(folder, make, task, progress);
}

void StreamedSolve::solveWhole(
  vtkPointSet& mesh, JobTask& task, const PieceReading& reading, Progress& progress)
{
  const auto make = [&](const std::filesystem::path& container, Progress& written, Report& notes)
  {
    requireNumbers(mesh, task.columns().required);
    const ConversionReport converted = this->writeWhole(mesh, reading, container, written);
    notes.notes = converted.notes;
    if (converted.higher_order_cells > 0)
    {
      notes.warn(
        counted(converted.higher_order_cells,
          "cell of higher order counts by its corners alone: its other points have no ",
          "cells of higher order count by their corners alone: their other points have no ") +
        "result (Tessellate of ParaView makes linear cells of them)");
    }
  };
  this->solveOn([&] { return folderFor(mesh, reading); }, make, task, progress);
}

std::vector<double> StreamedSolve::valuesOfPoints()
{
  const auto columns = static_cast<std::size_t>(this->Result->columns());
  std::vector<std::int64_t> known;
  std::ranges::copy_if(this->VertexOfPoint, std::back_inserter(known),
    [](std::int64_t vertex) { return vertex >= 0; });
  std::vector<double> found(known.size() * columns);
  readValues(*this->Result, known, found);
  std::vector<double> values(this->VertexOfPoint.size() * columns, std::nan(""));
  auto from = found.begin();
  for (std::size_t i = 0; i < this->VertexOfPoint.size(); ++i)
  {
    if (this->VertexOfPoint[i] >= 0)
    {
      std::copy_n(from, columns, values.begin() + static_cast<std::ptrdiff_t>(i * columns));
      from += static_cast<std::ptrdiff_t>(columns);
    }
  }
  return values;
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

void StreamedSolve::solveFile(const std::filesystem::path& file, const std::string& fingerprint,
  JobTask& task, const PieceReading& reading, Progress& progress)
{
  try
  {
    this->discard();
    task.check();
    this->Scratch = std::make_unique<ScratchFolder>(reading.scratch, reading.scratchLimit);
    const VsmReader mesh(file, nullptr, fingerprint);
    mesh.requireBlocksWithin(std::max(reading.memory, MinConversionMemory));
    const Report report = this->solveOnFile(mesh, task, functionOf(progress));
    this->Summary = SolveSummary::of(report, this->Result->columns());
  }
  catch (const std::exception& error)
  {
    this->fail(error.what());
  }
}

Report StreamedSolve::solveOnFile(
  const VsmReader& mesh, JobTask& task, const ProgressFunction& progress)
{
  Report report;
  this->Result = task.solve(mesh, this->Scratch->path(), progress, report);
  return report;
}

void StreamedSolve::solveOn(
  const MakeFolder& folder, const MakeMesh& make, JobTask& task, Progress& progress)
{
  try
  {
    this->discard();
    task.check();
    const auto start = std::chrono::steady_clock::now();
    this->Scratch = folder();
    const std::filesystem::path container = *this->Scratch / "mesh.vsm";
    const ProgressFunction whole = functionOf(progress);
    Progress made(partOf(whole, 0.0, ReadShare));
    Report ofMesh;
    make(container, made, ofMesh);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

    const VsmReader file(container);
    const bool isSurface = file.info().cellType == CellType::Triangle;
    Report report = this->solveOnFile(file, task, partOf(whole, ReadShare, 1.0));
    FileDescriptor::removeClosed(container);
    if (const auto loose = std::ranges::count(this->VertexOfPoint, -1); loose > 0)
    {
      report.notes.push_back(noteOnLoose(loose, isSurface) +
                             ": there is no solution (NaN) and no distance there, and "
                             "what is smoothed, moved or blended stays as it was");
    }
    report.seconds.convert = seconds.count();
    report.seconds.total += seconds.count();
    report.notes.insert(report.notes.end(), ofMesh.notes.begin(), ofMesh.notes.end());
    report.warnings.insert(report.warnings.end(), ofMesh.warnings.begin(), ofMesh.warnings.end());
    this->Summary = SolveSummary::of(report, this->Result->columns());
  }
  catch (const std::exception& error)
  {
    this->fail(error.what());
  }
}

ConversionReport StreamedSolve::writeWhole(vtkPointSet& mesh, const PieceReading& reading,
  const std::filesystem::path& container, Progress& progress)
{
  ConversionOptions options;
  options.memoryLimit = std::max(reading.memory, MinConversionMemory);
  options.scratch = this->Scratch->path();
  options.threads = reading.threads;
  options.codec = Codec::Lz4;
  options.progress = functionOf(progress);
  const ConversionReport report = writeOrdinaryMesh(*withoutTexts(mesh), container, options);

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
  return report;
}

} // namespace smg
