// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/JobTask.h"

#include "Filters/Pieces/PieceBlock.h"
#include "Filters/Regions/RegionArrays.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Jobs/ReadOptions.h"

#include <utility>

namespace smg
{
namespace
{

/** The share of the job in the progress; what follows from its result takes the rest. */
constexpr double JobShare = 0.9;

} // namespace

std::string noteOnPreview(std::int64_t vertices, const char* result, const char* done)
{
  return std::string(result) + ", a mesh of " + std::to_string(vertices) +
         " vertices: the full mesh is " + done + " when it is saved, or with Solve: Full Mesh";
}

void JobTask::setLimits(const SolveOptions& options)
{
  JobLimits& limits = this->job().limits;
  limits = { options.memoryLimit, options.threads, options.scratch, options.scratchLimit };
  this->job().setLimits(limits);
}

PieceColumns JobTask::columns() const
{
  return { .all = false,
    .required = this->required(),
    .optional = { CellFlagsName, OriginalIdName, OriginalCellIdName } };
}

std::set<std::string> JobTask::required() const
{
  return columnsOf(this->job());
}

JobTask::Result JobTask::resultOn(const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->prepareFor(mesh.info());
  Result result;
  result.solution = this->run(mesh, partOf(progress, 0.0, JobShare));
  result.report = result.solution->report();
  this->complete(result, mesh, partOf(progress, JobShare, 1.0));
  result.report.notes.insert(result.report.notes.end(), this->notes.begin(), this->notes.end());
  return result;
}

std::unique_ptr<Solution> JobTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report)
{
  this->job().limits.scratch = scratch;
  this->job().setLimits(this->job().limits);
  Result result = this->resultOn(mesh, progress);
  report = std::move(result.report);
  return std::move(result.solution);
}

SolveSummary JobTask::solveInMemory(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values)
{
  this->check();
  dropEmptyRegions(mesh, this->places());
  const StoredBlock stored(mesh, this->required());
  this->adaptTo(mesh, stored.info());
  this->job().keepInMemory();
  Result result = this->resultOn(stored, progress);
  Solution& solution = *result.solution;
  values.resize(static_cast<std::size_t>(solution.vertices() * solution.columns()));
  solution.read(0, solution.vertices(), values);
  result.report.notes.push_back(
    noteOnPreview(result.report.vertices, this->ResultOnPreview, this->Done));
  return SolveSummary::of(result.report, solution.columns());
}

} // namespace smg
