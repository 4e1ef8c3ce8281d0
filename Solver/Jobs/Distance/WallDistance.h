// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/DistanceRun.h"
#include "smg/Distance.h"

#include <memory>
#include <string>

namespace smg
{

/**
 * The Euclidean distance to walls: see smg::distance(). As many wall triangles as the memory limit
 * allows are in memory, with a tree; a pass over the vertices finds the nearest of them. Each
 * further part of the wall takes another pass, so that the result is exact with any limit.
 */
std::unique_ptr<Solution> wallDistance(const StoredMesh& mesh,
  const DistanceDescription& description, std::unique_ptr<DistanceRun> run,
  const std::string& name);

} // namespace smg
