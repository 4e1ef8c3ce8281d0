// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/MemoryEstimate.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Core/Workers.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>

// Memory before the mesh is read. Out of core the windows have a number of nodes proportional to
// the span of the stream order, because a stage waits for the largest neighbour of its node: so the
// bytes are a constant times the span, and that constant depends on the type of the cells, the
// number of columns and the sweeps. The constants are measured (docs/performance.md, "Estimates").

namespace smg
{
namespace
{

// Measured on surfaces and tetrahedral meshes of 40 thousand to 3 million vertices. Each constant
// is the smallest of all meshes, so that a solve that fits is not refused.

/** Bytes of the windows of all levels per node of the span of the stream, and per value of the
 * state of a node: in the first pass with two sweeps, for each further sweep, and for each
 * sweep in a later pass. */
constexpr std::int64_t TriangleBytes = 4100, TetrahedronBytes = 3300, ValueBytes = 280;
constexpr std::int64_t FurtherSweepBytes = 250;
constexpr std::int64_t LaterSweepBytes = 400, LaterSweepValueBytes = 75;

/** Cotangent weights lead to more C-points than uniform ones: percent of the bytes above. */
constexpr std::int64_t CotangentPercent = 108;

/** The windows contain at least the nodes of this many spans, unless the mesh has fewer. */
constexpr std::int64_t WindowSpans = 30;

/** What waits between concurrent tasks: measured 3 MiB for surfaces of 40 thousand vertices, 6
 * MiB for those of 3 and 11 million, and less for solids. The longer steps for many threads
 * (Schedule::stepFor()) take up to three times as much, again less for solids. */
constexpr std::int64_t BetweenTasks = std::int64_t(6) << 20;

/** The bytes between tasks out of core, for this number of threads; 0: one per core. */
std::int64_t betweenTasks(const StreamInfo& info, int threads, std::int64_t least)
{
  if (threads == 1)
  {
    return 0;
  }
  const std::int64_t few = std::min(least, BetweenTasks);
  const int used = threads > 0 ? threads : Workers::cores();
  const bool areLong = Schedule::stepFor(used, 1) > 1;
  return !areLong ? few : info.cellType == CellType::Triangle ? 3 * few : few + few / 4;
}

/** Bytes per vertex in core. */
constexpr std::int64_t TriangleCoreBytes = 120, TetrahedronCoreBytes = 280, ValueCoreBytes = 20;

} // namespace

/** The larger one of the first pass, which builds the hierarchy, and of a later one, which has
 * the windows of two V-cycles: with many sweeps the later ones need more. */
std::int64_t leastMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes)
{
  const bool surface = info.cellType == CellType::Triangle;
  const std::int64_t stride = strideOf(columns);
  if (options.inCore)
  {
    return info.vertices * ((surface ? TriangleCoreBytes : TetrahedronCoreBytes) +
                             ValueCoreBytes * stride + furtherCoreBytes);
  }
  // An unknown span permits no statement; 0 refuses nothing.
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

std::int64_t expectedMemory(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options)
{
  // Besides the windows there are the core levels, and buffers. AboveMinimum is in percent.
  constexpr std::int64_t AboveMinimum = 130, CoreBytes = 70;
  const std::int64_t least = leastMemory(info, columns, weights, options, 0);
  const std::int64_t windows = least * AboveMinimum / 100;
  if (options.inCore)
  {
    return windows;
  }
  return windows + betweenTasks(info, options.threads, least) +
         std::min(info.vertices, options.coreNodes) * CoreBytes;
}

void requireMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes)
{
  const std::int64_t need = leastMemory(info, columns, weights, options, furtherCoreBytes);
  if (need > options.memoryLimit)
  {
    // More threads take more memory only where the limit leaves room.
    SolveOptions alone = options;
    alone.threads = 1;
    const std::int64_t expected = expectedMemory(info, columns, weights, alone) +
                                  (options.inCore ? furtherCoreBytes * info.vertices : 0);
    throw MemoryLimitError(need, options.memoryLimit).expecting(expected);
  }
}

bool permitsTasks(const StreamInfo& info, const Problem& problem, const SolveOptions& options)
{
  SolveOptions several = options;
  // For any number of threads the same: with two, whatever was asked for.
  several.threads = 2;
  if (info.vertices <= 0)
  {
    return false; // nothing is known of the need
  }
  StreamInfo known = info;
  known.span = info.span < 0 ? info.vertices : info.span; // the largest possible one
  const std::int64_t expected =
    expectedMemory(known, problem.columns(), problem.weights(), several);
  // Slivers need up to twice as much as expected, and acceleration a fifth more: hence the factor
  // of 2.5.
  return options.memoryLimit > expected / 2 * 5;
}

} // namespace smg
