// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkBlendTask.h"

#include "Filters/Pieces/vtkPieceBlock.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/Error.h"

#include <set>
#include <string>

namespace smg
{
namespace
{

/** The columns that the description names. */
std::set<std::string> namesInBlend(const BlendDescription& description)
{
  std::set<std::string> names = namedColumns(description.hold);
  names.insert(description.columns.begin(), description.columns.end());
  names.insert(description.patch);
  return names;
}

} // namespace

void BlendTask::check() const
{
  checkOptions(this->options);
  refuseAutomaticTolerance(this->options, "a blend");
  if (this->description.patch.empty())
  {
    throw Error("Patch must name the array with the patch of each point or cell.");
  }
  if (this->description.columns.empty())
  {
    throw Error("Arrays must name at least one point array to blend.");
  }
}

PieceColumns BlendTask::columns() const
{
  return { .all = false,
    .required = namesInBlend(this->description),
    .optional = { CellFlagsName, OriginalIdName, OriginalCellIdName } };
}

Costs BlendTask::costs(const StreamInfo& info) const
{
  constexpr int Usual = 3;
  int components = 0;
  for (const std::string& name : this->description.columns)
  {
    components += expectedComponents(info, name, Usual);
  }
  return blendCosts(info, components, this->description.seam, this->options);
}

std::unique_ptr<Solution> BlendTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report) const
{
  SolveOptions given = this->options;
  given.scratch = scratch;
  given.progress = progress;
  std::unique_ptr<Solution> solution = blend(mesh, this->description, given);
  report = solution->report();
  return solution;
}

SolveSummary BlendTask::solveOnPreview(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) const
{
  this->check();
  SolveOptions given = this->options;
  given.inCore = true;
  given.progress = progress;
  BlendDescription asked = this->description;
  dropEmptyRegions(mesh, asked.hold);
  const StoredBlock stored(mesh, namesInBlend(asked));
  const std::unique_ptr<Solution> solution = blend(stored, asked, given);
  values.resize(static_cast<std::size_t>(solution->vertices() * solution->columns()));
  solution->read(0, solution->vertices(), values);
  Report report = solution->report();
  report.notes.push_back("this is the blended preview, a mesh of " +
                         std::to_string(report.vertices) +
                         " vertices; the full mesh is blended when it is saved");
  return SolveSummary::of(report, solution->columns());
}

} // namespace smg
