// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/ChunkedMesh.h"

#include "smg/Error.h"

namespace smg
{

ChunkPlan ChunkPlan::of(const StreamInfo& mesh, std::int64_t span, bool sources)
{
  // A longer window takes fewer passes, a shorter one less memory. Of tetrahedra, whose span is
  // long, fewer spans are needed.
  constexpr std::int64_t LeastLength = 16384;
  const std::int64_t spans = mesh.cellType == CellType::Triangle ? 16 : 4;
  ChunkPlan plan;
  plan.cellType = mesh.cellType;
  plan.span = std::max<std::int64_t>(span, 1);
  plan.length = std::max(LeastLength, spans * plan.span);
  if (mesh.vertices > 0)
  {
    plan.length = std::max(std::min(plan.length, mesh.vertices), plan.span);
  }
  plan.singlePositions = !mesh.doublePositions;
  plan.sources = sources;
  if (plan.window() > INT32_MAX)
  {
    throw Error("the span of the stream, " + std::to_string(span) +
                " vertices, is too long for distances: convert the mesh with the order bfs");
  }
  return plan;
}

} // namespace smg
