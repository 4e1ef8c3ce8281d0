// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/DistanceJob.h"

#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/SolvedMesh.h"

namespace smg
{

void DistanceJob::setLimits(const JobLimits& limits)
{
  this->options.memoryLimit = limits.memory > 0 ? limits.memory : this->options.memoryLimit;
  this->options.threads = limits.threads;
  this->options.scratch = limits.scratch;
  this->options.scratchLimit = limits.scratchLimit;
}

std::vector<ColumnSpec> DistanceJob::solutionColumns(const StreamInfo& /*info*/) const
{
  return distanceColumns(this->description);
}

Costs DistanceJob::costsOn(const StreamInfo& info) const
{
  return distanceCosts(info, this->description);
}

AddedValues DistanceJob::addedTo(const StreamInfo& /*info*/) const
{
  return { distanceColumns(this->description), {} };
}

std::unique_ptr<Solution> DistanceJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->options.progress = progress;
  return distance(mesh, this->description, this->options, this->name);
}

void DistanceJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  // Sources and directions of other distances would be taken for those of these.
  ReplacedColumns result(mesh, solution, distanceColumns(this->description),
    { DistanceSourceName, DistanceGroupName, DistanceDirectionName });
  read(result, progress);
}

bool DistanceJob::keeps(const ColumnSpec& column, const StreamInfo& /*info*/) const
{
  return column.name != DistanceSourceName && column.name != DistanceGroupName &&
         column.name != DistanceDirectionName;
}

std::string DistanceJob::fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
{
  return vertices == 1 ? "is not reached." : "are not reached.";
}

} // namespace smg
