// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/PathDistance.h"

#include "Solver/Core/Text.h"
#include "Solver/Jobs/Distance/ChunkedMesh.h"
#include "Solver/Jobs/Distance/DistanceRun.h"
#include "Solver/Jobs/Distance/GeodesicMarch.h"
#include "Solver/Jobs/Distance/March.h"
#include "Solver/Jobs/Distance/ShortestPath.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "Solver/Mesh/StreamCheck.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

// Distances along paths in the mesh: sources are found, the mesh is cut into chunks on scratch
// files (ChunkedMesh), the front marches through them until nothing changes (GeodesicMarch,
// exactly, or March). The solution reads the scratch files.
//
// The memory is checked twice: before the mesh is read, with the mean number of cells in a chunk,
// so that a limit that is far too low is reported at once; and before the march, with the exact
// numbers.

namespace smg
{

namespace
{

/** Share of the first reading in the progress. */
constexpr double FirstReading = 0.3;

/** The scratch files of a distance, which its solution keeps alive. */
struct DistanceFiles
{
  DistanceFiles(const ChunkPlan& plan, DistanceRun& run)
    : chunks(plan, run.options.scratch, run.traffic)
  {
  }
  ChunkedMesh chunks;
};

/** The span of a stream whose information does not have it: takes a reading of the mesh. Chunks
 * must be at least as long as the span, so it cannot be guessed. */
std::int64_t measuredSpan(const StoredMesh& mesh)
{
  const std::unique_ptr<MeshSource> source = mesh.source({}, {});
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.info().cellType));
  std::int64_t span = 0;
  for (MeshBlock block; source->next(block);)
  {
    for (std::size_t c = 0; c < block.corners.size(); c += corners)
    {
      const auto [low, high] = std::ranges::minmax(std::span(block.corners).subspan(c, corners));
      span = std::max(span, high - low);
    }
  }
  return span;
}

/** The bytes of the march for chunks with at most this many cells. */
std::int64_t neededBytes(const ChunkPlan& plan, bool isExact, std::int64_t vertices,
  std::int64_t innerCells, std::int64_t crossingCells)
{
  return isExact ? GeodesicMarch::bytes(plan, vertices, innerCells, crossingCells)
                 : March::bytes(plan, vertices, innerCells, crossingCells);
}

/** Tells of distances that are approximate since the mesh is large: nobody has asked for that. */
void noteAccuracy(
  const StreamInfo& mesh, const DistanceDescription& description, bool isExact, Report& report)
{
  if (!isExact && mesh.cellType == CellType::Triangle &&
      description.accuracy == PathAccuracy::Automatic)
  {
    DistanceDescription exact = description;
    exact.accuracy = PathAccuracy::Exact;
    const auto seconds = static_cast<std::int64_t>(std::ceil(distanceCosts(mesh, exact).seconds));
    report.notes.push_back(
      "The distances are approximate, since the surface has more than " +
      groupedDigits(MaxExactVertices) +
      " vertices: too long, by less than 1 % on scans, by more where triangles "
      "are long and thin. Exact ones (accuracy) take about " +
      std::to_string(seconds) + " s.");
  }
}

/** What the sources are. */
struct SourceCounts
{
  explicit SourceCounts(const DistanceDescription& description)
  {
    for (const Where& place : description.from)
    {
      const std::size_t here = pointsOf(place);
      this->points += here;
      this->hasRegion = this->hasRegion || here == 0;
    }
  }
  /** Whether there may be several points, or points and regions. */
  bool haveSeveralFronts() const { return this->points > (this->hasRegion ? 0 : 1); }

  std::size_t points = 0;
  bool hasRegion = false;
};

/** Throws Error before the work, rather than in the middle of it. */
void checkMemory(std::int64_t needed, const Pool& pool)
{
  if (needed > pool.limit())
  {
    throw MemoryLimitError(needed, pool.limit(), DistanceMemory).expecting(needed);
  }
}

/** The largest numbers of inner and of crossing cells in a chunk, not necessarily the same one. */
ChunkedMesh::Chunk largestOf(const ChunkedMesh& mesh)
{
  ChunkedMesh::Chunk largest;
  for (const ChunkedMesh::Chunk& chunk : mesh.chunks)
  {
    largest.innerCells = std::max(largest.innerCells, chunk.innerCells);
    largest.crossingCells = std::max(largest.crossingCells, chunk.crossingCells);
  }
  return largest;
}

/** The formulas of the front multiply up to six lengths: their products must neither overflow nor
 * underflow. */
void checkExtent(const std::vector<double>& low, const std::vector<double>& high)
{
  constexpr double Least = 1e-47, Most = 1e47;
  double extent = 0;
  for (std::size_t k = 0; k < low.size(); ++k)
  {
    extent = std::max(extent, high[k] - low[k]);
  }
  if (extent > Most || (extent > 0 && extent < Least))
  {
    throw Error("the extent of the mesh must lie between 1e-47 and 1e47 for distances: scale it");
  }
}

/** Reads the mesh once: cuts it into chunks, marks sources, collects their facets if wanted, and
 * checks the stream and its extent. */
void readMesh(const StoredMesh& mesh, DistanceSources& sources, SourceFacets* facets,
  ChunkedMesh& chunks, DistanceRun& run)
{
  const std::unique_ptr<MeshSource> source = sources.read(mesh);
  ChunkWriter writer(chunks, sources, facets, run.pool);
  std::vector<double> low(3, HUGE_VAL), high(3, -HUGE_VAL);
  const auto all = static_cast<double>(std::max<std::int64_t>(mesh.info().vertices, 1));
  const StreamCheck check = forCheckedBlocks(*source,
    [&](const MeshBlock& block)
    {
      writer.add(block);
      for (std::size_t i = 0; i < block.positions.size(); ++i)
      {
        low[i % 3] = std::min(low[i % 3], block.positions[i]);
        high[i % 3] = std::max(high[i % 3], block.positions[i]);
      }
      const auto read = static_cast<double>(block.firstVertex + block.vertices());
      run.progress.update(FirstReading * read / all);
    });
  check.finish(mesh.info());
  writer.finish();
  sources.finish();
  run.report.vertices = chunks.vertices;
  run.report.cells = writer.cells();
  run.report.degenerate_cells = writer.skipped();
  run.report.prescribed = run.report.distance->sources = writer.sources();
  // A selection that is empty has been an error above; "everywhere" in an empty mesh is not one of
  // these.
  if (writer.sources() == 0)
  {
    throw Error("a distance needs at least one source, but the mesh has no vertex");
  }
  checkExtent(low, high);
  noteUnwelded(chunks.plan.cellType, check.vertices(), check.cells(), run.report);
}

/** Cuts the mesh into chunks, and finds the nearest sources of its vertices, if these are wanted.
 */
void prepareMesh(const StoredMesh& mesh, std::optional<DistanceSources>& sources,
  ChunkedMesh& chunks, DistanceRun& run)
{
  sources->prepare(mesh, run.options.scratch);
  std::optional<BlockStore> file;
  std::optional<SourceFacets> facets;
  if (chunks.plan.nearest)
  {
    facets.emplace(file.emplace(run.options.scratch / "sources", run.traffic.add("sources")));
  }
  readMesh(mesh, *sources, facets ? &*facets : nullptr, chunks, run);
  // Gives its memory back before what follows.
  sources.reset();
  if (facets)
  {
    const std::int64_t count = facets->finish();
    Workers threads(run.options.threads);
    findNearestSources(chunks, *file, count, threads, run.progress, run.pool);
  }
}

/** What marches. */
std::unique_ptr<ChunkMarch> marchOf(ChunkedMesh& chunks, bool isExact, Pool& pool)
{
  if (isExact)
  {
    return std::make_unique<GeodesicMarch>(chunks, pool);
  }
  return std::make_unique<March>(chunks, pool);
}

/** A vertex whose path is wanted. */
struct PathEnd
{
  std::int64_t vertex, number; ///< in the stream, in the original file
};

/** The vertices whose paths are wanted: takes readings of the mesh of its own. */
std::vector<PathEnd> pathEnds(const StoredMesh& mesh, const DistanceDescription& description,
  const std::string& name, DistanceRun& run)
{
  std::vector<PathEnd> ends;
  if (description.to.empty())
  {
    return ends;
  }
  DistanceSources selected(
    description.to, DataPlace::Vertices, false, mesh.info(), name, run.pool, "to");
  selected.prepare(mesh, run.options.scratch);
  const std::unique_ptr<MeshSource> source = selected.read(mesh);
  for (MeshBlock block; source->next(block);)
  {
    run.progress.poll();
    const std::span<const std::uint8_t> isEnd = selected.verticesAt(block);
    for (std::size_t i = 0; i < isEnd.size(); ++i)
    {
      if (isEnd[i])
      {
        ends.push_back(
          { block.firstVertex + static_cast<std::int64_t>(i), selected.numberOf(block, i) });
      }
    }
    if (std::ssize(ends) > MaxPaths)
    {
      throw Error(name + ": to: paths to more than " + groupedDigits(MaxPaths) +
                  " vertices are selected, which is the largest number.");
    }
  }
  selected.finish();
  return ends;
}

/** Names the vertices to which there is no path: who draws the paths sees fewer than were wanted.
 */
void noteMissing(Report& report, double within)
{
  constexpr std::int64_t Named = 10;
  std::int64_t missing = 0;
  std::string numbers;
  for (const Report::Path& path : report.distance->paths)
  {
    if (std::isfinite(path.length))
    {
      continue;
    }
    if (++missing <= Named)
    {
      numbers += (missing == 1 ? "" : ", ") + std::to_string(path.to);
    }
  }
  if (missing > 0)
  {
    const bool isOne = missing == 1;
    report.notes.push_back(
      (isOne ? "There is no path to vertex " : "There are no paths to vertices ") + numbers +
      (missing > Named ? " and " + std::to_string(missing - Named) + " more" : "") +
      ": no source reaches " + (isOne ? "it" : "them") +
      (std::isinf(within) ? "." : " within a distance of " + shortest(within) + "."));
  }
}

/** Marches, reports the passes, and follows paths. */
void march(ChunkedMesh& chunks, bool isExact, const std::vector<PathEnd>& ends, DistanceRun& run)
{
  const std::unique_ptr<ChunkMarch> marching = marchOf(chunks, isExact, run.pool);
  Report& report = run.report;
  run.beginPasses();
  report.passes = marching->run(run.maxPasses, run.progress, FirstReading,
    [&](std::int64_t unsettled)
    { run.endPass(static_cast<double>(unsettled) / static_cast<double>(chunks.vertices)); });
  report.peak_nodes = std::min(chunks.plan.window(), chunks.vertices);
  report.distance->mesh_readings = marching->meshReadings();
  report.distance->unsettled = marching->unsettled();
  report.converged = report.distance->unsettled == 0;
  if (!report.converged)
  {
    report.notes.push_back("After " + counted(report.passes, "pass", "passes") +
                           ", the largest number allowed, " +
                           counted(report.distance->unsettled, "vertex", "vertices") +
                           " had changes to pass on: some distances are too large.");
  }
  ShortestPath path(marching->window(), run.progress);
  for (const PathEnd& end : ends)
  {
    Report::Path found = path.to(end.vertex);
    found.to = end.number;
    run.pool.acquire(std::ssize(found.points) * std::int64_t(sizeof(found.points[0])));
    if (found.points.empty() && std::isfinite(found.length))
    {
      report.notes.push_back("The shortest path to vertex " + std::to_string(end.number) +
                             " could not be followed: it is left out.");
    }
    report.distance->paths.push_back(std::move(found));
  }
  std::ranges::sort(report.distance->paths, {}, &Report::Path::to);
  noteMissing(report, chunks.plan.within);
}

/** Makes what is farther than wanted as if it had not been reached. */
void leaveOutFar(ChunkedMesh& chunks)
{
  const double within = chunks.plan.within;
  if (std::isinf(within))
  {
    return;
  }
  std::vector<double> distances;
  std::vector<std::int64_t> sources;
  std::vector<float> directions;
  for (std::int64_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    const auto count = static_cast<std::size_t>(chunks.countOf(chunk));
    const auto part = [&](ChunkedMesh::StatePart which, auto& values, std::size_t components)
    {
      const std::int64_t index = chunk * ChunkedMesh::StateParts + which;
      values.resize(chunks.state.bytes(index) > 0 ? components * count : 0);
      chunks.state.read(index, std::as_writable_bytes(std::span(values)));
      return index;
    };
    const std::int64_t index = part(ChunkedMesh::Distances, distances, 1);
    if (std::ranges::none_of(
          distances, [within](double d) { return d > within && !std::isinf(d); }))
    {
      continue;
    }
    const std::int64_t ofSources = part(ChunkedMesh::Sources, sources, 1);
    const std::int64_t ofDirections = part(ChunkedMesh::Directions, directions, 3);
    for (std::size_t i = 0; i < count; ++i)
    {
      if (distances[i] > within)
      {
        distances[i] = HUGE_VAL;
        std::fill_n(sources.begin() + static_cast<std::ptrdiff_t>(i), sources.empty() ? 0 : 1, -1);
        std::fill_n(directions.begin() + static_cast<std::ptrdiff_t>(3 * i),
          directions.empty() ? 0 : 3, 0.0F);
      }
    }
    chunks.state.write(index, std::as_bytes(std::span(distances)));
    if (!sources.empty())
    {
      chunks.state.write(ofSources, std::as_bytes(std::span(sources)));
    }
    if (!directions.empty())
    {
      chunks.state.write(ofDirections, std::as_bytes(std::span(directions)));
    }
  }
}

/** The columns of the solution, in the order of distanceColumns(), and where they are stored. */
std::vector<StoredColumn> columnsOf(DistanceFiles& files, const DistanceDescription& description)
{
  // Blocks that were never written have a value of their own: infinity, and -1 for no source.
  using Type = StoredColumn::Type;
  BlockStore* state = &files.chunks.state;
  std::vector<StoredColumn> columns{ { state, ChunkedMesh::StateParts, ChunkedMesh::Distances,
    Type::Float64, 1, HUGE_VAL } };
  if (description.source)
  {
    columns.push_back({ state, ChunkedMesh::StateParts, ChunkedMesh::Sources, Type::Int64, 1, -1,
      description.group ? numberOfLabel : nullptr });
  }
  if (description.group)
  {
    columns.push_back(
      { state, ChunkedMesh::StateParts, ChunkedMesh::Sources, Type::Int64, 1, -1, groupOfLabel });
  }
  if (description.direction)
  {
    columns.push_back(
      { state, ChunkedMesh::StateParts, ChunkedMesh::Directions, Type::Float32, 3, 0 });
  }
  return columns;
}

} // namespace

std::unique_ptr<Solution> pathDistance(const StoredMesh& mesh,
  const DistanceDescription& description, std::unique_ptr<DistanceRun> run, const std::string& name,
  std::int64_t chunkVertices)
{
  const StreamInfo& info = mesh.info();
  if (description.from.empty())
  {
    throw Error(name + ": a distance needs at least one source.");
  }
  std::optional<DistanceSources> sources(
    std::in_place, description.from, DataPlace::Vertices, description.group, info, name, run->pool);
  const bool isExact = isExactDistance(info, description);
  // Where the fronts of several points meet, each cell must know which ones.
  const SourceCounts counts(description);
  const bool needSources = description.source || description.group || !description.to.empty() ||
                           (!isExact && counts.haveSeveralFronts());
  ChunkPlan plan = ChunkPlan::of(
    info, info.span >= 0 ? info.span : measuredSpan(mesh), needSources, description.direction);
  plan.within = description.within;
  plan.arrivals = !description.to.empty();
  plan.roots = info.cellType == CellType::Tetrahedron && counts.points > 0;
  plan.nearest = !isExact && counts.hasRegion;
  if (chunkVertices > 0)
  {
    // Tests take short chunks, so that small meshes have many.
    plan.length = std::max(chunkVertices, plan.span);
  }
  if (info.vertices > 0)
  {
    // A mesh that is shorter than a chunk needs less memory.
    plan.length = std::max(std::min(plan.length, info.vertices), plan.span);
    // With the mean number of cells in a chunk, taken as inner ones.
    const double share = std::min(1.0, double(plan.length) / double(info.vertices));
    const auto cells = static_cast<std::int64_t>(std::ceil(share * double(info.cells)));
    checkMemory(neededBytes(plan, isExact, info.vertices, cells, 0), run->pool);
  }
  run->report.distance = Report::Distance{};
  run->report.distance->exact = isExact;
  auto files = std::make_shared<DistanceFiles>(plan, *run);
  ChunkedMesh& chunks = files->chunks;
  noteAccuracy(info, description, isExact, run->report);
  const Timer building;
  const std::vector<PathEnd> ends = pathEnds(mesh, description, name, *run);
  prepareMesh(mesh, sources, chunks, *run);
  run->report.seconds.build = building.seconds();
  const ChunkedMesh::Chunk largest = largestOf(chunks);
  checkMemory(
    neededBytes(plan, isExact, chunks.vertices, largest.innerCells, largest.crossingCells),
    run->pool);
  march(chunks, isExact, ends, *run);
  leaveOutFar(chunks);
  const std::vector<StoredColumn> columns = columnsOf(*files, description);
  auto solution = std::make_unique<DistanceSolution>(
    std::move(run), std::move(files), columns, chunks.vertices, plan.length);
  solution->finish();
  return solution;
}

} // namespace smg
