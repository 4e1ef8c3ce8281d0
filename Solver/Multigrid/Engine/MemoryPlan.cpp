// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/MemoryPlan.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Core/Workers.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <limits>

// Out of core the windows have a number of nodes proportional to the span of the stream order,
// because a stage waits for the largest neighbour of its node: so the bytes are a constant times
// the span, and that constant depends on the type of the cells, the number of columns and the
// sweeps. Later passes are measured against what the first one has needed. All constants are at the
// beginning; they are measured (docs/performance.md, "Estimates").

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

/** Bytes per vertex in core. */
constexpr std::int64_t TriangleCoreBytes = 120, TetrahedronCoreBytes = 280, ValueCoreBytes = 20;

/** What is expected is more than the least, in percent of the windows, and has core levels. */
constexpr std::int64_t AboveLeast = 130, CoreNodeBytes = 70;

/** A limit of so many times what two threads are expected to need is ample: slivers need up to
 * twice as much as expected, and acceleration a fifth more. */
constexpr std::int64_t AmpleHalves = 5;

/** Core levels take at most this part of the limit; bytes per node of the finest one of a surface,
 * with all coarser levels: those of solids have fewer nodes than the bounds of shares. */
constexpr std::int64_t CorePart = 3, BytesPerCoreNode = 200;
/** Upper bounds of the share of C-points: 0.24 to 0.43 were measured on the finest level, 0.14 to
 * 0.31 on coarser ones. */
constexpr double FirstShare = 0.43, FurtherShare = 0.31;
/** The finest core level of a mesh of unknown size. */
constexpr int UnknownCoreLevel = 4;

/** A later pass in one chain needs up to so many eighths or tenths more than the first one, or than
 * a plain one that was measured: bounds of what surfaces, solids and scans of 50 thousand to 2.8
 * million vertices needed. Most need less, down to a third of the first one; on slivers they need
 * up to 1.1 times as much. */
constexpr std::int64_t FirstMargin = 8, PlainMargin = 10;
/** Bytes of a node of the finest level, with coarser levels, that a chain keeps: 220 of surfaces.
 */
constexpr std::int64_t ChainNodeBytes = 400;
/** A history has values of the nodes in the window and in so many blocks that are prefetched or
 * wait to be written; its steps and residuals, in quarters of these values. */
constexpr std::int64_t HistoryBlocks = 6, StepQuarters = 5, ResidualQuarters = 7;
/** Rings grow by pages, and ahead of need. */
constexpr std::int64_t Pages = std::int64_t(1) << 16;

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
  // Besides the windows there are the core levels, and buffers.
  const std::int64_t least = leastMemory(info, columns, weights, options, 0);
  const std::int64_t windows = least * AboveLeast / 100;
  if (options.inCore)
  {
    return windows;
  }
  return windows + betweenTasks(info, options.threads, least) +
         std::min(info.vertices, options.coreNodes) * CoreNodeBytes;
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

void MemoryPlan::estimate(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options)
{
  // More threads take more memory only where the limit leaves room.
  SolveOptions of = options;
  of.threads = 1;
  const bool isKnown = info.vertices > 0 && (info.span >= 0 || of.inCore);
  this->Expected = isKnown ? expectedMemory(info, columns, weights, of) : 0;
  // With two threads, whatever was asked for: the choice of acceleration depends on the answer.
  of.threads = 2;
  StreamInfo known = info;
  known.span = info.span < 0 ? info.vertices : info.span; // the largest possible one
  this->Ample = info.vertices > 0 &&
                this->Limit > expectedMemory(known, columns, weights, of) / 2 * AmpleHalves;
}

int MemoryPlan::firstCoreLevel(std::int64_t vertices, std::int64_t coarsest) const
{
  if (vertices <= 0)
  {
    return UnknownCoreLevel;
  }
  const auto most =
    static_cast<double>(std::min(this->CoreNodes, this->Limit / CorePart / BytesPerCoreNode));
  double nodes = FirstShare * static_cast<double>(vertices);
  int level = 1;
  for (; nodes > most && nodes > static_cast<double>(coarsest); ++level)
  {
    nodes *= FurtherShare;
  }
  return level;
}

void MemoryPlan::endFirstPass(std::int64_t valueNodes)
{
  this->FirstPassPeak = this->Memory.peak();
  this->ValueNodes = valueNodes;
}

void MemoryPlan::endPlainPass(std::int64_t valueNodes)
{
  this->PlainPassPeak = this->Memory.recentPeak();
  this->ValueNodes = valueNodes;
}

/** The bytes of the pool that a pass out of core needs in one chain: a bound. */
std::int64_t MemoryPlan::passBytes(int stride, std::optional<std::int64_t> sparseness) const
{
  std::int64_t bytes = this->PlainPassPeak > 0
                         ? this->PlainPassPeak + this->PlainPassPeak / PlainMargin
                         : this->FirstPassPeak + this->FirstPassPeak / FirstMargin;
  if (sparseness)
  {
    const std::int64_t kept = this->ValueNodes + HistoryBlocks * RowBlock::Nodes;
    const std::int64_t values = kept * stride * std::int64_t(sizeof(double));
    bytes += values * StepQuarters / 4 +
             (*sparseness > 0 ? values * ResidualQuarters / 4 / *sparseness : 0);
  }
  return bytes;
}

bool MemoryPlan::hasRoom(std::int64_t nodes, int stride, KeptResiduals residuals) const
{
  if (this->InCore)
  {
    const std::int64_t need = nodes * IterateHistory::nodeBytes(stride, residuals);
    return this->Memory.used() + need + need / 4 + Pages <= this->Limit;
  }
  if (this->Ample && this->Expected > 0)
  {
    return true; // the limit is far above the need
  }
  return this->passBytes(stride, IterateHistory::sparseness(nodes, residuals)) <= this->Limit;
}

std::optional<KeptResiduals> MemoryPlan::residualsThatFit(
  std::int64_t nodes, int stride, KeptResiduals wanted) const
{
  if (this->hasRoom(nodes, stride, wanted))
  {
    return wanted;
  }
  if (wanted != KeptResiduals::None && this->hasRoom(nodes, stride, KeptResiduals::Few))
  {
    return KeptResiduals::Few;
  }
  return std::nullopt;
}

auto MemoryPlan::stepsOf(std::int64_t nodes, int stride, std::optional<std::int64_t> sparseness,
  int threads) const -> Steps
{
  // Each chain keeps the nodes of a step in memory; in core all nodes are there anyway.
  const auto chainsFor = [&](std::int64_t step)
  {
    if (this->InCore)
    {
      return std::numeric_limits<std::int64_t>::max();
    }
    // At least a bit more than the first pass needed, since a pass that two systems share has the
    // values of both.
    const std::int64_t first = this->FirstPassPeak;
    const std::int64_t need = std::max(first + first / 16, this->passBytes(stride, sparseness));
    return (this->Limit - need) / (ChainNodeBytes * std::min(step, nodes));
  };
  const std::int64_t wanted = Schedule::chainsFor(threads);
  const std::int64_t longer = Schedule::stepFor(threads, this->BlockNodes);
  const std::int64_t step = chainsFor(longer) < wanted ? this->BlockNodes : longer;
  return { step, static_cast<int>(std::clamp(chainsFor(step), std::int64_t(1), wanted)) };
}

} // namespace smg
