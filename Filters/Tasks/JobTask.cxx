// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/JobTask.h"

#include "Filters/Pieces/PieceBlock.h"
#include "Filters/Regions/RegionArrays.h"
#include "IO/Jobs/ReadOptions.h"

namespace smg
{

std::string noteOnPreview(std::int64_t vertices, const std::string& result, const std::string& done)
{
  return result + ", a mesh of " + std::to_string(vertices) + " vertices: the full mesh is " +
         done + " when it is saved";
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
    .required = columnsOf(this->job()),
    .optional = { CellFlagsName, OriginalIdName, OriginalCellIdName } };
}

std::unique_ptr<Solution> JobTask::run(
  const StoredMesh& mesh, const ProgressFunction& progress, Report& report)
{
  std::unique_ptr<Solution> solution = this->run(mesh, progress);
  report = solution->report();
  this->complete(report);
  return solution;
}

std::unique_ptr<Solution> JobTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report)
{
  this->job().limits.scratch = scratch;
  this->job().setLimits(this->job().limits);
  return this->run(mesh, progress, report);
}

SolveSummary JobTask::solveInMemory(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values)
{
  this->check();
  dropEmptyRegions(mesh, this->places());
  const StoredBlock stored(mesh, columnsOf(this->job()));
  this->adaptTo(mesh, stored.info());
  this->job().keepInMemory();
  Report report;
  const std::unique_ptr<Solution> solution = this->run(stored, progress, report);
  values.resize(static_cast<std::size_t>(solution->vertices() * solution->columns()));
  solution->read(0, solution->vertices(), values);
  report.notes.push_back(noteOnPreview(report.vertices, this->Result, this->Done));
  return SolveSummary::of(report, solution->columns());
}

} // namespace smg
