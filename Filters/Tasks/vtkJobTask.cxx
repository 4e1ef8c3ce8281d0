// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkJobTask.h"

#include "Filters/Pieces/vtkPieceBlock.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Solver/Problem/ComposeDescriptions.h"

namespace smg
{

std::string noteOnPreview(std::int64_t vertices, const std::string& result, const std::string& done)
{
  return result + ", a mesh of " + std::to_string(vertices) + " vertices: the full mesh is " +
         done + " when it is saved";
}

std::set<std::string> JobTask::names() const
{
  std::set<std::string> names = namedColumns(this->places);
  names.insert(this->arrays.begin(), this->arrays.end());
  return names;
}

PieceColumns JobTask::columns() const
{
  return { .all = false,
    .required = this->names(),
    .optional = { CellFlagsName, OriginalIdName, OriginalCellIdName } };
}

std::unique_ptr<Solution> JobTask::run(const StoredMesh& mesh, SolveOptions given,
  const ProgressFunction& progress, Report& report) const
{
  given.progress = progress;
  std::unique_ptr<Solution> solution = this->run(mesh, given);
  report = solution->report();
  this->complete(report);
  return solution;
}

std::unique_ptr<Solution> JobTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report) const
{
  SolveOptions given = this->options;
  given.scratch = scratch;
  return this->run(mesh, given, progress, report);
}

SolveSummary JobTask::solveInMemory(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values)
{
  this->check();
  dropEmptyRegions(mesh, this->places);
  const StoredBlock stored(mesh, this->names());
  this->adaptTo(mesh, stored.info());
  SolveOptions given = this->options;
  given.inCore = true;
  Report report;
  const std::unique_ptr<Solution> solution = this->run(stored, given, progress, report);
  values.resize(static_cast<std::size_t>(solution->vertices() * solution->columns()));
  solution->read(0, solution->vertices(), values);
  report.notes.push_back(noteOnPreview(report.vertices, this->Result, this->Done));
  return SolveSummary::of(report, solution->columns());
}

} // namespace smg
