// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/MemoryEstimate.h"

#include "Solver/Cycle/Lanes.h"

#include <algorithm>

namespace smg
{
namespace
{

// Measured on surfaces and tetrahedral meshes of 40 thousand to 3 million vertices, rounded down to
// the least need seen (uniform weights, two sweeps), so that a solve that fits is not refused.

/** Bytes of all windows of the first pass for one node of the stream's span, and for each value of
 * its state. */
constexpr std::int64_t TriangleBytes = 6300, TetrahedronBytes = 6500, ValueBytes = 300;

/** The windows hold at least this many spans' worth of nodes, unless the mesh has fewer. */
constexpr std::int64_t WindowSpans = 30;

/** Bytes a vertex in core. */
constexpr std::int64_t TriangleCoreBytes = 100, TetrahedronCoreBytes = 180, ValueCoreBytes = 20;

} // namespace

std::int64_t estimateMemory(const StreamInfo& info, int columns, const SolveOptions& options)
{
  const bool surface = info.cellType == CellType::Triangle;
  const std::int64_t stride = strideOf(columns);
  if (options.inCore)
  {
    return info.vertices *
           ((surface ? TriangleCoreBytes : TetrahedronCoreBytes) + ValueCoreBytes * stride);
  }
  if (info.span < 0)
  {
    return 0;
  }
  const std::int64_t nodes = std::min(info.span, info.vertices / WindowSpans);
  return nodes * ((surface ? TriangleBytes : TetrahedronBytes) + ValueBytes * stride);
}

} // namespace smg
