// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/vtkDeformationTask.h"

#include "Filters/Deformation/DeformedVertices.h"
#include "Filters/Handles/vtkHandleArrays.h"
#include "IO/Files/PartialProgress.h"
#include "Solver/Engine/CheckOptions.h"
#include "smg/DescribedHandles.h"

#include <algorithm>

namespace smg
{
namespace
{

/** The share of the solve in the progress; normals take the rest. */
constexpr double DeformShare = 0.9;

} // namespace

void DeformationTask::check() const
{
  checkOptions(this->options);
}

PieceColumns DeformationTask::columns() const
{
  const auto& names = HandleArrays::names();
  return {
    .all = false, .required = { names.begin(), names.end() }, .optional = { CellFlagsName }
  };
}

Costs DeformationTask::costs(const StreamInfo& info) const
{
  return deformCosts(info, this->options);
}

std::unique_ptr<Solution> DeformationTask::solve(const VsmReader& mesh,
  const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report) const
{
  const bool hasNormals = this->needsNormals && mesh.info().cellType == CellType::Triangle;
  DescribedHandles handles(DeformationDescription::byColumns(), mesh.info());
  DeformOptions options = this->options;
  options.scratch = scratch;
  options.progress = partOf(progress, 0.0, hasNormals ? DeformShare : 1.0);
  options.checkpoint.mesh = mesh.fingerprint();
  options.checkpoint.problem = "handles in the arrays of the mesh";
  auto moved = std::make_unique<DeformedVertices>(deform(*mesh.source(), handles, options));
  if (hasNormals)
  {
    NormalsOptions normals;
    normals.scratch = options.scratch;
    normals.memory = std::min(normals.memory, options.memoryLimit / 4);
    normals.progress = partOf(progress, DeformShare, 1.0);
    moved->addNormals(mesh.source({}, {}), normals);
  }
  report = moved->report();
  report.notes.insert(report.notes.end(), this->notes.begin(), this->notes.end());
  return moved;
}

} // namespace smg
