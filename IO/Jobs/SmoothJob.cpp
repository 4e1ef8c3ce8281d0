// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/SmoothJob.h"

#include "IO/Jobs/MovedResult.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Error.h"
#include "smg/Smooth.h"
#include "smg/SolvedMesh.h"

#include <algorithm>

namespace smg
{

std::string SmoothJob::resultColumns() const
{
  return this->smoothing.column.empty() ? std::string() : "the column " + this->smoothing.column;
}

std::vector<std::string> SmoothJob::changedColumns() const
{
  return this->smoothing.column.empty() ? std::vector<std::string>{}
                                        : std::vector{ this->smoothing.column };
}

std::vector<ColumnSpec> SmoothJob::solutionColumns(const StreamInfo& info) const
{
  if (this->smoothing.column.empty())
  {
    return { PositionSpec };
  }
  const auto found =
    std::ranges::find(info.vertexColumns, this->smoothing.column, &ColumnSpec::name);
  if (found == info.vertexColumns.end())
  {
    throw Error("'" + this->smoothing.column + "': the vertices have no column of this name");
  }
  return { *found };
}

bool SmoothJob::keeps(const ColumnSpec& column, const StreamInfo& info) const
{
  return !this->smoothing.column.empty() || keepsMoved(column, this->normals, info.cellType);
}

Costs SmoothJob::costsOn(const StreamInfo& info) const
{
  constexpr int OfPoints = 3;
  return smoothCosts(
    info, expectedComponents(info, this->smoothing.column, OfPoints), this->smoothing);
}

AddedValues SmoothJob::addedTo(const StreamInfo& info) const
{
  AddedValues added = replacedIn(info, this->changedColumns());
  added.movesVertices = this->smoothing.column.empty();
  return added;
}

std::unique_ptr<Solution> SmoothJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->complete(mesh, progress);
  return smooth(mesh, this->smoothing, this->smoothing);
}

void SmoothJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  if (!this->smoothing.column.empty())
  {
    ReplacedColumns smoothed(mesh, solution, this->solutionColumns(mesh.info()));
    read(smoothed, progress);
    return;
  }
  const MovedMesh moved(mesh, solution, this->normals, normalsOptions(*this, progress));
  read(*moved.source(), partOf(progress, NormalsShare, 1.0));
}

} // namespace smg
