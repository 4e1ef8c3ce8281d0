// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/DistanceRun.h"
#include "smg/Distance.h"

#include <memory>
#include <string>

namespace smg
{

/** The distance along paths in the mesh: see smg::distance(). `chunkVertices`, if positive, is the
 * length of the chunks of the march, at least the span; by default it follows from the stream. */
std::unique_ptr<Solution> pathDistance(const StoredMesh& mesh,
  const DistanceDescription& description, std::unique_ptr<DistanceRun> run, const std::string& name,
  std::int64_t chunkVertices = 0);

} // namespace smg
