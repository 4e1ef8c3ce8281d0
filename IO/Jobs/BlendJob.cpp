// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/BlendJob.h"

#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/SolvedMesh.h"

namespace smg
{

std::vector<ColumnSpec> BlendJob::solutionColumns(const StreamInfo& info) const
{
  return blendedColumns(info, this->description);
}

Costs BlendJob::costsOn(const StreamInfo& info) const
{
  // The columns of a mesh file that is not a .vsm are not known before it is read.
  constexpr int Usual = 3;
  int components = 0;
  for (const std::string& column : this->description.columns)
  {
    components += expectedComponents(info, column, Usual);
  }
  return blendCosts(info, components, this->description.seam, this->solving);
}

AddedValues BlendJob::addedTo(const StreamInfo& info) const
{
  return replacedIn(info, this->description.columns);
}

std::unique_ptr<Solution> BlendJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->complete(mesh, progress);
  return blend(mesh, this->description, this->solving);
}

void BlendJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  ReplacedColumns source(mesh, solution, this->solutionColumns(mesh.info()));
  read(source, progress);
}

std::string BlendJob::fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
{
  return vertices == 1 ? "keeps its values." : "keep their values.";
}

} // namespace smg
