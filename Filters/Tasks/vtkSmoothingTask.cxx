// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkSmoothingTask.h"

#include "Filters/Pieces/vtkPieceBlock.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "IO/Files/PartialProgress.h"
#include "IO/vtkMeshPieceData.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ComposeDescriptions.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace smg
{
namespace
{

/** The share of the smoothing in the progress; normals take the rest. */
constexpr double SmoothShare = 0.9;

/** The columns that the options name. */
std::set<std::string> namesIn(const Smoothing& options)
{
  std::set<std::string> names = namedColumns(options.hold);
  if (!options.column.empty())
  {
    names.insert(options.column);
  }
  return names;
}

} // namespace

void SmoothingTask::check() const
{
  checkOptions(this->options);
}

PieceColumns SmoothingTask::columns() const
{
  return { .all = false,
    .required = namesIn(this->options),
    .optional = { CellFlagsName, OriginalIdName, OriginalCellIdName } };
}

Costs SmoothingTask::costs(const StreamInfo& info) const
{
  constexpr int OfPoints = 3;
  return smoothCosts(info, expectedComponents(info, this->options.column, OfPoints), this->options);
}

std::unique_ptr<Solution> SmoothingTask::smoothed(
  const StoredMesh& mesh, bool inCore, const ProgressFunction& progress) const
{
  const bool hasNormals = this->needsNormals && this->options.column.empty();
  Smoothing given = this->options;
  given.inCore = inCore;
  given.progress = partOf(progress, 0.0, hasNormals ? SmoothShare : 1.0);
  std::unique_ptr<Solution> solution = smooth(mesh, given, given);
  if (!hasNormals)
  {
    return solution;
  }
  NormalsOptions normals;
  normals.scratch = given.scratch;
  normals.memory = std::min(normals.memory, given.memoryLimit / 4);
  normals.progress = partOf(progress, SmoothShare, 1.0);
  auto moved = std::make_unique<DeformedVertices>(std::move(solution));
  moved->addNormals(mesh.source({}, {}), normals);
  return moved;
}

std::unique_ptr<Solution> SmoothingTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report) const
{
  SmoothingTask task = *this;
  task.options.scratch = scratch;
  std::unique_ptr<Solution> solution = task.smoothed(mesh, false, progress);
  report = solution->report();
  return solution;
}

SolveSummary SmoothingTask::solveOnPreview(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) const
{
  this->check();
  SmoothingTask task = *this;
  dropEmptyRegions(mesh, task.options.hold);
  const StoredBlock stored(mesh, namesIn(task.options));
  if (task.options.size.unit == SmoothingSize::MeanEdges && cellsBehind(mesh) > 0)
  {
    // Those of the mesh: an area, or a volume, of so many more cells has shorter edges.
    const double share =
      static_cast<double>(mesh.GetNumberOfCells()) / static_cast<double>(cellsBehind(mesh));
    task.options.size.value *=
      stored.info().cellType == CellType::Triangle ? std::sqrt(share) : std::cbrt(share);
  }
  const std::unique_ptr<Solution> solution = task.smoothed(stored, true, progress);
  values.resize(static_cast<std::size_t>(solution->vertices() * solution->columns()));
  solution->read(0, solution->vertices(), values);
  Report report = solution->report();
  report.notes.push_back("this is the smoothed preview, a mesh of " +
                         std::to_string(report.vertices) +
                         " vertices: the full mesh is smoothed when it is saved");
  return SolveSummary::of(report, solution->columns());
}

} // namespace smg
