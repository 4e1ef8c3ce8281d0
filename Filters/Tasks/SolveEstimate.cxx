// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/SolveEstimate.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/SingleBlock.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Solver/Core/Text.h"
#include "smg/Convert.h"
#include "smg/Error.h"

#include "vtkAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>

namespace smg
{
namespace
{

ConversionOptions placesOf(const SolveOptions& options)
{
  ConversionOptions places;
  places.scratch = options.scratch;
  places.memoryLimit = options.memoryLimit;
  return places;
}

/** As "About 96 MiB of memory (the limit is 1024 MiB), ...". */
std::string textOf(const JobEstimate& estimate, std::int64_t scratchLimit)
{
  std::ostringstream text;
  text << "About " << mebibytes(estimate.memory_bytes) << " of memory (the limit is "
       << mebibytes(estimate.memory_limit) << "), " << mebibytes(estimate.scratch_bytes)
       << " of scratch files (";
  if (scratchLimit > 0)
  {
    text << "the limit is " << mebibytes(scratchLimit) << ", ";
  }
  text << freeSpace(estimate.scratch_free) << "), " << estimate.passes
       << (estimate.passes == 1 ? " pass" : " passes") << " over "
       << groupedDigits(estimate.vertices) << " points and " << groupedDigits(estimate.cells)
       << " cells, " << std::llround(std::ceil(estimate.cpu_seconds)) << " s of CPU; saved as .vsm "
       << mebibytes(estimate.output_bytes);
  return text.str();
}

/** The .vsm file that the input of the filter names; one that is not converted yet is named by its
 * reader, and its conversion is part of the cost. Empty: none. */
std::string fileOf(vtkAlgorithm& filter)
{
  const bool isConnected = filter.GetNumberOfInputConnections(0) > 0;
  vtkInformation* info = isConnected ? filter.GetInputInformation(0, 0) : nullptr;
  const char* file = info ? info->Get(vtkStreamingMeshKeys::STREAM_FILE()) : nullptr;
  if (file && !info->Has(vtkStreamingMeshKeys::PREVIEWED()))
  {
    vtkAlgorithm* at = &filter;
    while (!at->IsA("vtkStreamingMeshReader") && at->GetNumberOfInputPorts() > 0 &&
           at->GetNumberOfInputConnections(0) > 0)
    {
      at = at->GetInputAlgorithm(0, 0);
    }
    auto* reader = vtkStreamingMeshReader::SafeDownCast(at);
    // Filters behind the reader have its information of the last update, before a conversion.
    const bool isConverted = reader && reader->GetFullNumberOfPoints() >= 0;
    file = isConverted ? reader->GetOutputInformation(0)->Get(vtkStreamingMeshKeys::STREAM_FILE())
           : reader    ? static_cast<const char*>(reader->GetFileName())
                       : nullptr;
  }
  return file ? file : "";
}

/** What a computation on the input of the filter costs. Throws Error, with a reason. */
JobEstimate estimateFor(
  vtkAlgorithm& filter, const ConversionOptions& places, const EstimateOf& estimateOf)
{
  vtkNew<vtkPolyData> nothing;
  const vtkSmartPointer<vtkPointSet> present = meshOf(filter.GetInputDataObject(0, 0));
  if (const std::string file = fileOf(filter); !file.empty())
  {
    return estimateOf({ file, places }, present ? *present : *nothing);
  }
  if (isFailed(filter.GetInputDataObject(0, 0)))
  {
    throw Error("the input has failed: see the error of the filter before this one.");
  }
  if (present && lacksStreamNumbering(*present) && !isPreview(*present) && !hasSeveralProcesses())
  {
    return estimateOf({ ordinaryMeshInfo(*present), places }, *present);
  }
  const bool isShown = present && present->GetNumberOfPoints() > 0;
  // A piece that was requested is released after the solve.
  const bool isApplied = present && present->GetUpdateTime() > 0;
  throw Error(isShown && isPreview(*present)
                ? "the input is a preview, and no file tells the size of the mesh."
              : isShown || isApplied
                ? "the input is one piece of a mesh, whose size no file tells."
                : "the filter before this one has not been applied, or has no mesh.");
}

/** Of a solve. */
EstimateOf estimateOfSolve(const TaskOf& taskOf, const SolveOptions& options)
{
  return [&taskOf, &options](const EstimatedInput& in, vtkPointSet& present)
  {
    const std::unique_ptr<JobTask> task = taskOf(present);
    const Costs costs = task->costs(in.info);
    JobEstimate estimate(in, { "result.vsm", task->added(in.info) }, costs, placesOf(options));
    estimate.memory_limit = options.memoryLimit;
    // The pieces are on a scratch file, of 0.8 to 1.3 times the bytes of their .vsm file on these
    // meshes, while they are solved on. Saving is not part of the solve.
    estimate.scratch_bytes =
      task->isInMemory() ? 0 : std::max(in.conversionScratch, in.streamBytes + costs.scratch);
    estimate.cpu_seconds = costs.seconds + in.conversionSeconds + readingSeconds(in.info);
    return estimate;
  };
}

} // namespace

double readingSeconds(const StreamInfo& mesh)
{
  // That of pvpython besides the solve, on surfaces of 168 and 720 thousand vertices and on
  // tetrahedra of 59 thousand; on an AMD EPYC as the times in Solver/Jobs/Estimate/Costs.cpp.
  const double ofVertex = mesh.cellType == CellType::Triangle ? 0.5e-6 : 2e-6;
  return ofVertex * static_cast<double>(mesh.vertices);
}

std::string estimateText(vtkAlgorithm& filter, const ConversionOptions& places,
  const EstimateOf& estimateOf, std::int64_t scratchLimit)
{
  try
  {
    return textOf(estimateFor(filter, places, estimateOf), scratchLimit);
  }
  catch (const Error& error)
  {
    return "Not known: " + std::string(error.what());
  }
}

std::string solveEstimate(vtkAlgorithm& filter, const TaskOf& taskOf, const SolveOptions& options)
{
  return estimateText(
    filter, placesOf(options), estimateOfSolve(taskOf, options), options.scratchLimit);
}

std::optional<double> solveSeconds(
  vtkAlgorithm& filter, const TaskOf& taskOf, const SolveOptions& options)
{
  try
  {
    return estimateFor(filter, placesOf(options), estimateOfSolve(taskOf, options)).cpu_seconds;
  }
  catch (const Error&)
  {
    return std::nullopt;
  }
}

namespace
{

template <class Value>
void addColumn(vtkTable& table, const char* name, const SolveSummary& summary, Value value)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  double number = 0.0;
  for (const Report::Pass& pass : summary.facts.by_pass)
  {
    number += 1.0;
    column->InsertNextValue(value(pass, number));
  }
  table.AddColumn(column);
}

/** Of what would be a horizontal line in a chart. */
void removeConstantColumns(vtkTable& table, vtkIdType from)
{
  for (vtkIdType c = table.GetNumberOfColumns() - 1; c >= from; --c)
  {
    double range[2] = { 0.0, 0.0 };
    vtkArrayDownCast<vtkDoubleArray>(table.GetColumn(c))->GetRange(range);
    if (range[0] == range[1])
    {
      table.RemoveColumn(c);
    }
  }
}

} // namespace

void fillPasses(const SolveSummary& summary, vtkTable& table)
{
  using Pass = Report::Pass;
  table.Initialize();
  addColumn(table, "Pass", summary, [](const Pass&, double number) { return number; });
  addColumn(table, "Residual", summary, [](const Pass& pass, double) { return pass.residual; });
  addColumn(table, "Seconds", summary, [](const Pass& pass, double) { return pass.seconds; });
  addColumn(table, "Read (MiB)", summary,
    [](const Pass& pass, double) { return static_cast<double>(pass.read) / MiB; });
  addColumn(table, "Written (MiB)", summary,
    [](const Pass& pass, double) { return static_cast<double>(pass.written) / MiB; });
  addColumn(table, "Memory (MiB)", summary,
    [](const Pass& pass, double) { return static_cast<double>(pass.pool_bytes) / MiB; });
  constexpr vtkIdType Further = 3; // after those of every solve
  removeConstantColumns(table, Further);
}

void fillText(const SolveSummary& summary, vtkTable& table)
{
  table.Initialize();
  vtkNew<vtkStringArray> text;
  text->SetName("Text");
  text->InsertNextValue(summary.where('\n')); // for narrow views
  table.AddColumn(text);
}

} // namespace smg
