// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/DeformationTask.h"

#include "Filters/Regions/HandleArrays.h"
#include "Filters/Regions/RegionPoints.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "Filters/Tasks/InteractiveMesh.h"
#include "IO/Jobs/MovedResult.h"
#include "IO/Results/MovedPoints.h"
#include "IO/Vtk/MeshPieceData.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/DescribedHandles.h"

#include <string>
#include <utility>
#include <vector>

namespace smg
{

DeformationTask::DeformationTask()
  : JobTask("deform")
  , asked(static_cast<DeformJob&>(this->job()))
{
  this->asked.description = DeformationDescription::byColumns();
  this->asked.text = "handles in the arrays of the mesh";
}

void DeformationTask::check() const
{
  checkOptions(this->asked.deforming);
}

std::set<std::string> DeformationTask::required() const
{
  const auto& names = HandleArrays::names();
  return { names.begin(), names.end() };
}

Costs DeformationTask::costs(const StreamInfo& info) const
{
  Costs costs = this->JobTask::costs(info);
  if (this->isInMemory())
  {
    costs.memory = BytesInMemory * info.vertices;
  }
  return costs;
}

/** Handles in arrays need no preparation, which would name the arrays where nothing is held. */
std::unique_ptr<Solution> DeformationTask::run(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  DescribedHandles handles(this->asked.description, mesh.info());
  this->asked.complete(mesh, progress);
  return deform(
    *mesh.source(handles.vertexColumns(), handles.cellColumns()), handles, this->asked.deforming);
}

void DeformationTask::complete(
  Result& result, const StoredMesh& mesh, const ProgressFunction& progress)
{
  std::vector<std::string> numbers; // for the note on inverted cells
  if (findColumn(mesh.info().cellColumns, OriginalCellIdSpec) >= 0)
  {
    numbers.emplace_back(OriginalCellIdName);
  }
  auto rest = mesh.source({}, numbers);
  const NormalsOptions reading = normalsOptions(this->asked, progress);
  if (this->needsNormals && mesh.info().cellType == CellType::Triangle)
  {
    result.solution = std::make_unique<DeformedVertices>(
      std::move(result.solution), std::move(rest), reading, &result.report);
    return;
  }
  MovedPoints stream(std::move(rest), *result.solution, &result.report, reading);
  visitBlocks(stream, progress, 0.0, 1.0, [](const MeshBlock&) {});
}

SolveSummary DeformationTask::solveInMemory(
  vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values)
{
  if (isPreview(mesh) && !this->needsHandles && !HandleArrays::holdAny(mesh))
  {
    return this->summaryOfUnmoved(mesh, values);
  }
  DeformOptions given = this->asked.deforming;
  given.progress = progress;
  given.checkpoint = {};
  values = this->interactive->deform(mesh, given, this->needsNormals);
  Report report = this->interactive->report();
  if (!isPreview(mesh))
  {
    this->interactive->judge(report);
    return SolveSummary::of(report, this->interactive->columns());
  }
  report.notes.push_back(this->noteOnPreview(report.vertices));
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
              "with Solve set to Full Mesh, or by Save Data, the mesh itself is deformed");
  return SolveSummary::of(report, columns);
}

} // namespace smg
