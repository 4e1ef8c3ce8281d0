// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/DeformJob.h"

#include "IO/Files/PartialProgress.h"
#include "IO/Jobs/MovedResult.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/DescribedHandles.h"

namespace smg
{

std::vector<ColumnSpec> DeformJob::solutionColumns(const StreamInfo& /*info*/) const
{
  return { PositionSpec };
}

bool DeformJob::keeps(const ColumnSpec& column, const StreamInfo& info) const
{
  return keepsMoved(column, this->normals, info.cellType);
}

Costs DeformJob::costsOn(const StreamInfo& info) const
{
  return deformCosts(info, this->deforming);
}

std::unique_ptr<Solution> DeformJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  DescribedHandles handles(this->description, mesh.info(), this->name);
  const auto source = [&] { return mesh.source(handles.vertexColumns(), handles.cellColumns()); };
  handles.prepare(*source(), this->deforming.scratch, this->deforming.memoryLimit);
  this->complete(mesh, progress);
  auto positions = deform(*source(), handles, this->deforming);
  this->Notes = handles.notes();
  return positions;
}

void DeformJob::passResult(const StoredMesh& mesh, Solution& positions, const Reader& read,
  Report& report, const ProgressFunction& progress) const
{
  const MovedMesh moved(mesh, positions, this->normals, normalsOptions(*this, progress));
  read(*moved.source(&report), partOf(progress, NormalsShare, 1.0));
  report.notes.insert(report.notes.end(), this->Notes.begin(), this->Notes.end());
}

} // namespace smg
