// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/MemoryEstimate.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/Pipeline.h"

#include <tbb/info.h>

#include <algorithm>

namespace smg
{
namespace
{

// Measured on surfaces and tetrahedral meshes of 40 thousand to 3 million vertices, rounded down to
// the minimum, so that a solve that fits is not refused.

/** Bytes of all windows per node of the stream's span, and per value of its state: in the first
 * pass with two sweeps, for each further sweep, and in a later pass for each sweep. */
constexpr std::int64_t TriangleBytes = 4100, TetrahedronBytes = 3300, ValueBytes = 280;
constexpr std::int64_t FurtherSweepBytes = 250;
constexpr std::int64_t LaterSweepBytes = 400, LaterSweepValueBytes = 75;

/** Cotangent weights make more nodes coarse than uniform ones: percent of the bytes above. */
constexpr std::int64_t CotangentPercent = 108;

/** The windows hold at least the nodes of this many spans, unless the mesh has fewer. */
constexpr std::int64_t WindowSpans = 30;

/** What lies between the tasks of the first pass: measured 3 MiB for surfaces of 40 thousand
 * vertices, 6 MiB for those of 3 and 11 million, and less for solids. Longer steps for many threads
 * take up to three times as much, again less for solids. */
constexpr std::int64_t BetweenTasks = std::int64_t(6) << 20;

/** The bytes between tasks for so many threads, 0: one per core; out of core. */
std::int64_t betweenTasks(const StreamInfo& info, int threads, std::int64_t least)
{
  if (threads == 1)
  {
    return 0;
  }
  const std::int64_t few = std::min(least, BetweenTasks);
  const int used = threads > 0 ? threads : tbb::info::default_concurrency();
  const bool areLong = Pipeline::stepFor(used, 1) > 1;
  return !areLong ? few : info.cellType == CellType::Triangle ? 3 * few : few + few / 4;
}

/** Bytes per vertex in core. */
constexpr std::int64_t TriangleCoreBytes = 120, TetrahedronCoreBytes = 280, ValueCoreBytes = 20;

std::int64_t minMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes)
{
  const bool surface = info.cellType == CellType::Triangle;
  const std::int64_t stride = strideOf(columns);
  if (options.inCore)
  {
    return info.vertices * ((surface ? TriangleCoreBytes : TetrahedronCoreBytes) +
                             ValueCoreBytes * stride + furtherCoreBytes);
  }
  if (info.span < 0)
  {
    return 0;
  }
  const std::int64_t nodes = std::min(info.span, info.vertices / WindowSpans);
  const std::int64_t first = (surface ? TriangleBytes : TetrahedronBytes) + ValueBytes * stride +
                             FurtherSweepBytes * std::max(0, options.sweeps - 2);
  const std::int64_t later = options.sweeps * (LaterSweepBytes + LaterSweepValueBytes * stride);
  const std::int64_t percent = weights == Weights::Uniform ? 100 : CotangentPercent;
  return nodes * std::max(first, later) * percent / 100;
}

} // namespace

std::int64_t estimateMemory(const StreamInfo& info, const Problem& problem,
  const SolveOptions& options, std::int64_t furtherCoreBytes)
{
  return minMemory(info, problem.columns(), problem.weights(), options, furtherCoreBytes);
}

std::int64_t expectedMemory(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options)
{
  // Besides the windows there are the levels in core, and buffers.
  constexpr std::int64_t AboveMinimum = 130, CoreBytes = 70;
  const std::int64_t least = minMemory(info, columns, weights, options, 0);
  const std::int64_t windows = least * AboveMinimum / 100;
  if (options.inCore)
  {
    return windows;
  }
  return windows + betweenTasks(info, options.threads, least) +
         std::min(info.vertices, options.coreNodes) * CoreBytes;
}

bool permitsTasks(const StreamInfo& info, const Problem& problem, const SolveOptions& options)
{
  SolveOptions several = options;
  several.threads = 2;
  const std::int64_t expected = expectedMemory(info, problem.columns(), problem.weights(), several);
  // Slivers need up to twice as much as expected, and acceleration a fifth more.
  return options.memoryLimit > expected / 2 * 5;
}

} // namespace smg
