// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/DeformationTask.h"

#include "Filters/Regions/HandleArrays.h"
#include "Filters/Regions/RegionPoints.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "Filters/Tasks/InteractiveMesh.h"
#include "Filters/Tasks/JobTask.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Results/MovedPoints.h"
#include "IO/Vtk/MeshPieceData.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/DescribedHandles.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

/** The share of the solve in the progress; a reading of the deformed mesh takes the rest. */
constexpr double DeformShare = 0.9;

} // namespace

void DeformationTask::check() const
{
  checkOptions(this->options);
}

PieceColumns DeformationTask::columns() const
{
  const auto& names = HandleArrays::names();
  // The original ids are for the note on inverted cells.
  return { .all = false,
    .required = { names.begin(), names.end() },
    .optional = { CellFlagsName, OriginalCellIdName } };
}

Costs DeformationTask::costs(const StreamInfo& info) const
{
  Costs costs = deformCosts(info, this->options);
  if (this->options.inCore)
  {
    costs.memory = BytesInMemory * info.vertices;
  }
  return costs;
}

std::unique_ptr<Solution> DeformationTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report)
{
  const bool hasNormals = this->needsNormals && mesh.info().cellType == CellType::Triangle;
  DescribedHandles handles(DeformationDescription::byColumns(), mesh.info());
  DeformOptions options = this->options;
  options.scratch = scratch;
  options.progress = partOf(progress, 0.0, DeformShare);
  options.checkpoint.mesh = mesh.fingerprint();
  options.checkpoint.problem = "handles in the arrays of the mesh";
  auto moved = std::make_unique<DeformedVertices>(deform(*mesh.source(), handles, options));
  report = moved->report();
  NormalsOptions reading;
  reading.scratch = options.scratch;
  reading.memory = std::min(reading.memory, options.memoryLimit / 4);
  reading.progress = partOf(progress, DeformShare, 1.0);
  std::vector<std::string> numbers;
  if (findColumn(mesh.info().cellColumns, OriginalCellIdSpec) >= 0)
  {
    numbers.emplace_back(OriginalCellIdName);
  }
  auto rest = mesh.source({}, numbers);
  if (hasNormals)
  {
    moved->addNormals(std::move(rest), reading, &report);
  }
  else
  {
    MovedPoints stream(std::move(rest), *moved, &report, reading);
    visitBlocks(stream, progress, DeformShare, 1.0, [](const MeshBlock&) {});
  }
  report.notes.insert(report.notes.end(), this->notes.begin(), this->notes.end());
  return moved;
}

SolveSummary DeformationTask::solveInMemory(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values)
{
  if (isPreview(mesh) && !this->needsHandles && !HandleArrays::holdAny(mesh))
  {
    return this->summaryOfUnmoved(mesh, values);
  }
  DeformOptions given = this->options;
  given.progress = progress;
  given.checkpoint = {};
  values = this->interactive->deform(mesh, given, this->needsNormals);
  Report report = this->interactive->report();
  if (!isPreview(mesh))
  {
    this->interactive->judge(report);
    return SolveSummary::of(report, this->interactive->columns());
  }
  report.notes.push_back(
    noteOnPreview(report.vertices, "this is the deformed preview", "deformed"));
  if (isSurfaceOfSolid(mesh))
  {
    report.notes.push_back(
      std::string("the preview is the surface of the solid, on which handles inside have no "
                  "effect: ") +
      RemedyOfSurface);
  }
  return SolveSummary::of(report, this->interactive->columns());
}

/** Points of the mesh, of which a preview shows few, may well be held. */
SolveSummary DeformationTask::summaryOfUnmoved(
  vtkPointSet& preview, std::vector<double>& values) const
{
  const int columns = this->needsNormals ? DeformedVertices::WithNormals : 3;
  values = valuesAtRest(preview, columns);
  Report report;
  report.vertices = preview.GetNumberOfPoints();
  report.converged = true;
  report.warn(std::string("handles hold no point of the preview, which stays as it is: ") +
              (isSurfaceOfSolid(preview) ? std::string(RemedyOfSurface) + ", and " : "") +
              "Solve On Full Mesh, as Save Data, deforms the mesh itself");
  return SolveSummary::of(report, columns);
}

} // namespace smg
