// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/JobTask.h"

#include "Filters/Pieces/PieceBlock.h"
#include "Filters/Regions/RegionArrays.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Jobs/ReadOptions.h"
#include "smg/Error.h"

#include <algorithm>
#include <utility>

namespace smg
{
namespace
{

/** The share of the job in the progress; what follows from its result takes the rest. */
constexpr double JobShare = 0.9;

/** The option with the parts of the mesh to which Mesh Regions add; null: there is none. */
const WhereOption* partsOf(const Job& job)
{
  const auto table = job.table();
  const auto found = std::ranges::find_if(table, isKind<WhereOption>);
  return found == table.end() ? nullptr : &std::get<WhereOption>(found->kind);
}

} // namespace

JobTask::JobTask(const char* kind)
  : Kind(jobKind(kind))
  , Job(makeMeshJob(kind))
{
}

void JobTask::setColumns(std::vector<std::string> names)
{
  for (const JobOption& option : this->job().table())
  {
    if (const auto* columns = std::get_if<ColumnsOption>(&option.kind))
    {
      columns->member.set(this->job(), names);
    }
  }
}

void JobTask::check() const
{
  this->job().check();
  for (const JobOption& option : this->job().table())
  {
    const auto* column = std::get_if<ColumnOption>(&option.kind);
    const auto* columns = std::get_if<ColumnsOption>(&option.kind);
    const bool isMissing = (column && column->member.get(this->job())->empty()) ||
                           (columns && columns->member.get(this->job())->empty());
    if (option.isRequired && isMissing)
    {
      throw Error(propertyOf(option) + " must name the array" +
                  (column ? " to use." : "s to use, at least one."));
    }
  }
}

std::string JobTask::resultOnPreview() const
{
  return std::string("this is the ") + this->Kind.done + " preview";
}

std::string JobTask::noteOnPreview(std::int64_t vertices) const
{
  return this->resultOnPreview() + ", a mesh of " + std::to_string(vertices) +
         " vertices: the full mesh is " + this->Kind.done +
         " when it is saved, or with Solve: Full Mesh";
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
  if (const WhereOption* parts = partsOf(this->job()))
  {
    std::vector<Where> places = *parts->member.get(this->job());
    dropEmptyRegions(mesh, places);
    parts->member.set(this->job(), std::move(places));
  }
  const StoredBlock stored(mesh, this->required());
  this->adaptTo(mesh, stored.info());
  this->job().keepInMemory();
  Result result = this->resultOn(stored, progress);
  Solution& solution = *result.solution;
  values.resize(static_cast<std::size_t>(solution.vertices() * solution.columns()));
  solution.read(0, solution.vertices(), values);
  result.report.notes.push_back(this->noteOnPreview(result.report.vertices));
  return SolveSummary::of(result.report, solution.columns());
}

} // namespace smg
