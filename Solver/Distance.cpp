// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Distance.h"

#include "Solver/Jobs/Distance/DistanceRun.h"
#include "Solver/Jobs/Distance/PathDistance.h"
#include "Solver/Jobs/Distance/WallDistance.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"

#include <cmath>
#include <utility>

// The entry of distances: checks the options, and chooses between paths within the mesh and
// straight lines to its walls.

namespace smg
{

std::vector<ColumnSpec> distanceColumns(const DistanceDescription& description)
{
  // The last number is the value at vertices that the solution does not have.
  std::vector<ColumnSpec> columns{ { DistanceName, ScalarType::Float64, 1, HUGE_VAL } };
  if (description.source)
  {
    columns.push_back({ DistanceSourceName, ScalarType::Int64, 1, -1 });
  }
  if (description.group)
  {
    columns.push_back({ DistanceGroupName, ScalarType::Int32, 1, -1 });
  }
  if (description.direction)
  {
    columns.push_back({ DistanceDirectionName, ScalarType::Float64, 3, 0 });
  }
  return columns;
}

bool isExactDistance(const StreamInfo& mesh, const DistanceDescription& description)
{
  const bool isSmall = mesh.vertices >= 0 && mesh.vertices <= MaxExactVertices;
  return description.wall || (mesh.cellType == CellType::Triangle &&
                               (description.accuracy == PathAccuracy::Exact ||
                                 (description.accuracy == PathAccuracy::Automatic &&
                                   (isSmall || !description.to.empty()))));
}

/** The options are checked before anything is created or read. */
std::unique_ptr<Solution> distance(const StoredMesh& mesh, const DistanceDescription& description,
  const DistanceOptions& options, const std::string& name)
{
  require(options.memoryLimit > 0, "the memory limit must be positive");
  require(options.scratchLimit >= 0, "the limit of scratch files must not be negative");
  require(options.threads >= 0, "the number of threads must not be negative");
  require(options.maxPasses >= 1, "at least one pass must be allowed");
  require(description.accuracy != PathAccuracy::Exact || isExactDistance(mesh.info(), description),
    "distances through a solid are approximate: there are no exact ones");
  require(description.within > 0.0, "the largest distance must be positive"); // not NaN
  require(!description.wall || std::isinf(description.within),
    "a largest distance (within) is one of paths: leave it out with a wall");
  require(
    description.to.empty() || (!description.wall && isExactDistance(mesh.info(), description)),
    "shortest paths (to) are those of exact distances on a surface");
  // The scratch folder is created here, before the mesh is read: an error of the folder comes
  // first.
  auto run = std::make_unique<DistanceRun>(options);
  return description.wall ? wallDistance(mesh, description, std::move(run), name)
                          : pathDistance(mesh, description, std::move(run), name);
}

} // namespace smg
