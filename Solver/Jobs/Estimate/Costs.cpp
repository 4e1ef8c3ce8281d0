// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Estimate/Costs.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Engine/Corrections.h"
#include "Solver/Multigrid/Engine/ErrorBalance.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "Solver/Problem/Selection.h"

#include <algorithm>
#include <cmath>

// Expected costs of computations, before any is made: proportional to the numbers of vertices,
// passes and values, with constants that are fitted to measurements (docs/performance.md,
// "Estimates"). Memory comes from MemoryPlan, whose constants are fitted in the same way, and
// depends on the span of the stream, too. All of it is arithmetic on the numbers of a StreamInfo.

namespace smg
{
namespace
{

// Measured by Testing/Benchmarks/estimates.py on surfaces and tetrahedral meshes of 40 thousand to
// 4 million vertices, on an AMD EPYC: see docs/performance.md.

/** Constants of a kind of cells; bytes and seconds are per vertex. */
struct Rates
{
  double rowBytes;      ///< of the rows of all levels on disk
  double fewRowBytes;   ///< the same with the operators for few cycles
  double chunkBytes;    ///< of the mesh on disk for distances
  double buildSeconds;  ///< the first pass
  double passSeconds;   ///< a further pass
  double valueSeconds;  ///< a further pass, for each value
  double readSeconds;   ///< reading the mesh, or computing something from all cells
  double marchSeconds;  ///< a distance
  double decadeCycles;  ///< accelerated V-cycles by which the residual becomes a tenth
  double plainSlowdown; ///< how many more V-cycles there are without acceleration
  double spanFactor;    ///< of the span, which is a power of the number of vertices
  double spanPower;
};

constexpr Rates OfTriangles{ .rowBytes = 86,
  .fewRowBytes = 86,
  .chunkBytes = 40,
  .buildSeconds = 1.3e-6,
  .passSeconds = 0.06e-6,
  .valueSeconds = 0.02e-6,
  .readSeconds = 0.25e-6,
  .marchSeconds = 0.8e-6,
  .decadeCycles = 1.0,
  .plainSlowdown = 1.25,
  .spanFactor = 2.3,
  .spanPower = 0.5 };
constexpr Rates OfTetrahedra{ .rowBytes = 160,
  .fewRowBytes = 110,
  .chunkBytes = 105,
  .buildSeconds = 3.5e-6,
  .passSeconds = 0.14e-6,
  .valueSeconds = 0.03e-6,
  .readSeconds = 0.8e-6,
  .marchSeconds = 5e-6,
  .decadeCycles = 1.33,
  .plainSlowdown = 1.6,
  .spanFactor = 1.6,
  .spanPower = 2.0 / 3.0 };

const Rates& ratesOf(CellType cells)
{
  return cells == CellType::Triangle ? OfTriangles : OfTetrahedra;
}

std::int64_t bytesOf(const StreamInfo& info, double ofVertex)
{
  return static_cast<std::int64_t>(static_cast<double>(info.vertices) * ofVertex);
}

/** The number of V-cycles that a tolerance takes, if a problem takes `ease` times the usual number:
 * in proportion to the digits of the tolerance. */
int expectedCycles(const Rates& rates, const SolveOptions& options, double ease = 1.0)
{
  const bool isPlain = options.acceleration == AccelerationKind::None;
  const double tolerance = options.tolerance == SolveOptions::AutomaticTolerance
                             ? ErrorBalance::UsualResidual
                             : options.tolerance;
  const double cycles =
    -std::log10(tolerance) * rates.decadeCycles * (isPlain ? rates.plainSlowdown : 1.0) * ease;
  return std::clamp(static_cast<int>(std::ceil(cycles)), 1, options.maxCycles);
}

/** Bytes per vertex of the scratch files of the iterate: two generations on all levels, and a third
 * one with a checkpoint; with acceleration its history, too. */
double iterateBytes(int columns, const SolveOptions& options, int cycles)
{
  // The number of nodes of all levels over that of the finest one; and the number of V-cycles from
  // which acceleration pays.
  constexpr double AllLevels = 1.45;
  constexpr int MinAccelerated = 4;
  const bool accelerates =
    options.acceleration != AccelerationKind::None && cycles >= MinAccelerated;
  const double generations = options.checkpoint.folder.empty() ? 2.0 : 3.0;
  return sizeof(double) * columns * (generations * AllLevels + (accelerates ? 2.0 : 0.0));
}

/** Seconds per vertex of a pass that makes one V-cycle. Values are computed in groups of four. */
double passSeconds(const Rates& rates, int columns)
{
  return rates.passSeconds + rates.valueSeconds * strideOf(columns);
}

/** The costs of a solve with this many V-cycles: the first pass builds the hierarchy, each further
 * one makes a V-cycle. */
Costs costsOfCycles(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options, int cycles)
{
  const Rates& rates = ratesOf(info.cellType);
  Costs costs;
  costs.memory = expectedMemory(info, columns, weights, options);
  costs.passes = cycles + 1;
  constexpr double LabelBytes = 4;
  if (!options.inCore)
  {
    costs.scratch =
      bytesOf(info, rates.rowBytes + LabelBytes + iterateBytes(columns, options, cycles));
    // Without a checkpoint, only the solution stays until the result is written; all files of a
    // checkpoint do.
    costs.kept = options.checkpoint.folder.empty()
                   ? bytesOf(info, 2.0 * sizeof(double) * columns + LabelBytes)
                   : costs.scratch;
  }
  costs.seconds = static_cast<double>(info.vertices) *
                  (rates.buildSeconds + rates.readSeconds + cycles * passSeconds(rates, columns));
  return costs;
}

} // namespace

/** A correction builds the hierarchy once more. */
Costs solveCosts(const StreamInfo& info, int columns, Weights weights, const SolveOptions& options,
  double contrast)
{
  const Rates& rates = ratesOf(info.cellType);
  const auto costsOf = [&](const SolveOptions& of)
  { return costsOfCycles(info, columns, weights, of, expectedCycles(rates, of)); };
  Costs costs = costsOf(options);
  SolveOptions again = options;
  again.tolerance = correctionTolerance(contrast, options.tolerance);
  again.checkpoint = {};
  if (again.tolerance < 1.0)
  {
    const Costs correction = costsOf(again);
    costs.scratch = std::max(costs.scratch, costs.kept + correction.scratch);
    costs.kept += correction.kept;
    costs.passes += correction.passes;
    costs.seconds += correction.seconds;
  }
  return costs;
}

/** Two steps with the same number of V-cycles, which share a pass; the first one has four columns
 * and determines the need. */
Costs deformCosts(const StreamInfo& info, const DeformOptions& options)
{
  constexpr int RotationColumns = 4;
  const Rates& rates = ratesOf(info.cellType);
  const int cycles = options.cycles > 0 ? options.cycles : expectedCycles(rates, options);
  SolveOptions step = options;
  // By default, a given number of V-cycles is not accelerated.
  if (options.cycles > 0)
  {
    step.acceleration = AccelerationKind::None;
  }
  Costs costs = costsOfCycles(info, RotationColumns, options.weights, step, cycles);
  costs.passes = 2 * cycles + 1;
  costs.seconds += static_cast<double>(info.vertices) *
                   (rates.readSeconds + cycles * passSeconds(rates, RotationColumns));
  // The mesh at rest is on a scratch file, and in memory in the window of the shared pass. The rows
  // come from the operators for few V-cycles.
  constexpr double RestBytes = 30;
  constexpr std::int64_t OpenRestBytes = 64, WindowSpans = 30;
  costs.memory += OpenRestBytes * std::min(info.vertices, WindowSpans * info.span);
  const std::int64_t rest = options.inCore ? 0 : bytesOf(info, RestBytes);
  costs.scratch += options.inCore ? 0 : rest - bytesOf(info, rates.rowBytes - rates.fewRowBytes);
  costs.kept += rest;
  return costs;
}

/** Of positions each step is a solve, with edges to be kept two, beside readings for normals and
 * the swept volume. The steps of a column have one hierarchy. */
Costs smoothCosts(const StreamInfo& info, int components, const Smoothing& options)
{
  const bool movesPoints = options.column.empty();
  const bool keepsVolume = options.keepVolume && movesPoints;
  const int solves = options.steps * (options.keepEdges ? 2 : 1);
  // The winding is also found where that of the mesh cannot be computed with, which is not known
  // yet.
  const int readings = movesPoints
                         ? options.steps * ((options.keepEdges ? 1 : 0) + (keepsVolume ? 2 : 1)) +
                             (options.orient ? 1 : 0)
                         : 0;
  // The equations of a step couple vertices only within about the size of the details, which makes
  // them easier.
  constexpr double Ease = 0.65;
  const Rates& rates = ratesOf(info.cellType);
  const int cycles = expectedCycles(rates, options, Ease);
  const Costs step = costsOfCycles(info, components, Weights::Cotangent, options, cycles);
  const auto vertices = static_cast<double>(info.vertices);
  const double further =
    movesPoints ? step.seconds : vertices * cycles * passSeconds(rates, components);
  Costs costs = step;
  costs.passes = 1 + step.passes + (solves - 1) * (movesPoints ? step.passes : cycles) + readings;
  costs.seconds =
    step.seconds + (solves - 1) * further + (1 + readings) * vertices * rates.readSeconds;
  // Vertex files: the values, the next values, the presmoothed surface, and normals.
  const int files = 2 + (options.keepEdges ? 1 : 0) + (options.keepEdges || keepsVolume ? 1 : 0);
  const std::int64_t own = bytesOf(info, files * components * double(sizeof(double)));
  // What further steps of a column need beside the rows: masses.
  constexpr double RecordBytes = 9;
  const std::int64_t records = movesPoints || solves == 1 ? 0 : bytesOf(info, RecordBytes);
  (options.inCore ? costs.memory : costs.scratch) += own + records;
  costs.kept = options.inCore ? 0 : bytesOf(info, components * double(sizeof(double)));
  return costs;
}

/** A solve, beside readings for patches, averaged gradients and the steps that remain. */
Costs blendCosts(
  const StreamInfo& info, int components, SeamGradient seam, const SolveOptions& options)
{
  Costs costs = solveCosts(info, components, Weights::Cotangent, options);
  const int readings = seam == SeamGradient::Average ? 3 : 2;
  costs.passes += readings;
  costs.seconds +=
    readings * static_cast<double>(info.vertices) * ratesOf(info.cellType).readSeconds;
  const double gradients = seam == SeamGradient::Average ? 1.0 + 3.0 * components : 0.0;
  const std::int64_t own = bytesOf(info, (components + gradients) * double(sizeof(double)));
  (options.inCore ? costs.memory : costs.scratch) += own;
  return costs;
}

/** The number of passes of a march is not bounded in advance; this is the usual one. */
Costs distanceCosts(const StreamInfo& info, const DistanceDescription& description)
{
  const bool surface = info.cellType == CellType::Triangle;
  const auto vertices = static_cast<double>(info.vertices);
  const bool hasPaths = !description.to.empty();
  const double numbers =
    1.0 + description.source + description.group + 3.0 * description.direction + 6.0 * hasPaths;
  Costs costs;
  if (description.wall)
  {
    // The boundary of a compact body of n vertices has of the order of n^(2/3) triangles.
    constexpr double WallBytes = 2400, WallSeconds = 11e-6;
    costs.memory = static_cast<std::int64_t>(WallBytes * std::pow(vertices, 2.0 / 3.0));
    costs.scratch = costs.memory + bytesOf(info, 8.0 * numbers);
    costs.kept = bytesOf(info, 8.0 * numbers);
    costs.passes = 1;
    costs.seconds = vertices * WallSeconds;
    return costs;
  }
  const std::int64_t bytesOfSpan = surface ? 7300 : 5500;
  const std::int64_t least = std::int64_t(surface ? 1 : 3) << 20;
  costs.memory = least + bytesOfSpan * info.span;
  const bool hasRegion =
    std::ranges::any_of(description.from, [](const Where& place) { return pointsOf(place) == 0; });
  // NearestSource, or FrontRoot, for which bytesOfSpan has room in solids.
  constexpr std::int64_t RootBytes = 40, WindowSpans = 64;
  const bool hasNearest = hasRegion && !isExactDistance(info, description);
  costs.memory += surface && hasNearest ? RootBytes * WindowSpans * info.span : 0;
  costs.scratch = costs.kept = bytesOf(info,
    ratesOf(info.cellType).chunkBytes + (surface && !hasNearest ? 0 : RootBytes) + 8.0 * numbers);
  // Larger meshes have more paths that turn against the direction of the stream: one pass up to
  // OnePass vertices, and Growth more for a mesh e times as large.
  constexpr double OnePass = 170000, Growth = 0.94;
  costs.passes =
    std::max(1, static_cast<int>(std::lround(1.0 + Growth * std::log(vertices / OnePass))));
  costs.seconds = vertices * ratesOf(info.cellType).marchSeconds;
  if (isExactDistance(info, description))
  {
    // See GeodesicMarch::bytes() and ChunkPlan: about half of what is allowed for intervals.
    constexpr std::int64_t LeastBytes = 2 << 20, ChunkVertices = 16384;
    const std::int64_t bytesOfVertex = 120 + (hasPaths ? 40 : 0);
    // A front of intervals is about as long as the surface is wide in edges. Scans took 0.05 to
    // 0.14 of this unit; smooth and regular surfaces, which no count tells, up to 1.
    constexpr double ExactSeconds = 0.14e-6;
    const std::int64_t window = 4 * std::max(16 * info.span, ChunkVertices);
    costs.memory += LeastBytes + bytesOfVertex * std::min(info.vertices, window);
    costs.seconds = vertices * std::sqrt(vertices) * ExactSeconds;
  }
  return costs;
}

int expectedComponents(const StreamInfo& info, const std::string& column, int usual)
{
  const auto found = std::ranges::find(info.vertexColumns, column, &ColumnSpec::name);
  return found == info.vertexColumns.end() ? usual : found->components;
}

/** For a mesh that has not been ordered yet: of the order of its width, n^(1/2) or n^(2/3). */
std::int64_t usualSpan(CellType cells, std::int64_t vertices)
{
  const Rates& rates = ratesOf(cells);
  return static_cast<std::int64_t>(
    rates.spanFactor * std::pow(static_cast<double>(vertices), rates.spanPower));
}

} // namespace smg
