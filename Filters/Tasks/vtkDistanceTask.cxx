// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkDistanceTask.h"

#include "Filters/Pieces/vtkPieceBlock.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/Error.h"

#include "vtkPointSet.h"

#include <set>
#include <string>

namespace smg
{
namespace
{

/** A remark on the distances of a preview. */
std::string noteOnPreview(const Report& report)
{
  return "these are distances on the preview, a mesh of " + std::to_string(report.vertices) +
         " vertices; those of the full mesh are computed when it is saved";
}

/** Says that distances are infinite. */
void noteUnreached(Report& report)
{
  if (report.distance && report.distance->unreached > 0)
  {
    report.notes.push_back(std::to_string(report.distance->unreached) +
                           " vertices are not reached from any source: their distance is infinite");
  }
}

/** What to do about sources that a preview does not have. */
std::string hintOnPreview()
{
  return " This is about the preview, which has few vertices of the mesh: Save Data measures on "
         "the "
         "mesh itself; {\"nearest\": [[x, y, z]]} and Mesh Regions select sources on both.";
}

} // namespace

void DistanceTask::check() const
{
  if (this->description.from.empty() && !this->description.wall)
  {
    throw Error(
      "Nothing says where the distance is 0: put a Mesh Region before this filter, or set From "
      "(advanced), for example {\"vertices\": [5]}.");
  }
}

PieceColumns DistanceTask::columns() const
{
  return { .all = false,
    .required = namedColumns(this->description.from),
    .optional = { CellFlagsName, OriginalIdName, OriginalCellIdName } };
}

Costs DistanceTask::costs(const StreamInfo& info) const
{
  return distanceCosts(info, this->description);
}

AddedValues DistanceTask::added(const StreamInfo& /*info*/) const
{
  return { distanceColumns(this->description), {} };
}

std::unique_ptr<Solution> DistanceTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report) const
{
  DistanceOptions given = this->options;
  given.scratch = scratch;
  given.progress = progress;
  std::unique_ptr<Solution> solution = distance(mesh, this->description, given, "From");
  report = solution->report();
  noteUnreached(report);
  return solution;
}

SolveSummary DistanceTask::solveOnPreview(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) const
{
  this->check();
  DistanceOptions given = this->options;
  given.progress = progress;
  DistanceDescription asked = this->description;
  dropEmptyRegions(mesh, asked.from);
  if (asked.from.empty() && !this->description.from.empty())
  {
    throw Error(
      "No point of the preview lies in the region from which to measure." + hintOnPreview());
  }
  const StoredBlock stored(mesh, namedColumns(asked.from));
  std::unique_ptr<Solution> solution;
  try
  {
    solution = distance(stored, asked, given, "From");
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const Error& error)
  {
    throw Error(error.what() + hintOnPreview());
  }
  values.resize(static_cast<std::size_t>(solution->vertices() * solution->columns()));
  solution->read(0, solution->vertices(), values);
  Report report = solution->report();
  noteUnreached(report);
  report.notes.push_back(noteOnPreview(report));
  return SolveSummary::of(report, solution->columns());
}

} // namespace smg
