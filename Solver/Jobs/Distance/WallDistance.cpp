// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/WallDistance.h"

#include "Solver/Jobs/Distance/DistanceRun.h"
#include "Solver/Jobs/Distance/WallPass.h"
#include "Solver/Mesh/StreamCheck.h"
#include "smg/Error.h"

#include <tbb/info.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** The files of the triangles and of the distances. */
struct WallFiles
{
  explicit WallFiles(DistanceRun& run)
    : triangles(run.scratch / "wall", run.traffic.add("wall"))
    , values(run.scratch / "distances", run.traffic.add("distances"))
  {
  }
  ScratchBlocks triangles, values;
};

/** Triangles of the wall in memory. */
class WallPart
{
public:
  WallPart(Pool& pool, std::int64_t triangles)
    : PointMemory(pool, static_cast<std::size_t>(triangles) * sizeof(TrianglePoints))
    , NumberMemory(pool, static_cast<std::size_t>(triangles) * sizeof(Numbers))
    , Points(reinterpret_cast<TrianglePoints*>(this->PointMemory.data()),
        static_cast<std::size_t>(triangles))
    , CornerNumbers(
        reinterpret_cast<Numbers*>(this->NumberMemory.data()), static_cast<std::size_t>(triangles))
  {
  }

  using Numbers = std::array<std::int64_t, 3>;
  /** Memory a triangle, with the tree. */
  static constexpr std::int64_t TriangleBytes =
    sizeof(TrianglePoints) + sizeof(Numbers) + TriangleTree::BytesPerTriangle;

  /** Reads the triangles [first, first + size), where both are multiples of a block except at the
   * end of the file. */
  void read(ScratchBlocks& file, std::int64_t first)
  {
    std::vector<WallTriangle> block;
    std::size_t done = 0;
    for (std::int64_t b = first / WallTriangles::BlockTriangles; done < this->Points.size(); ++b)
    {
      block.resize(file.bytes(b) / sizeof(WallTriangle));
      file.read(b, std::as_writable_bytes(std::span(block)));
      for (const WallTriangle& triangle : block)
      {
        this->Points[done] = triangle.points;
        this->CornerNumbers[done++] = triangle.numbers;
      }
    }
  }

  std::span<const TrianglePoints> points() const { return this->Points; }
  std::span<const Numbers> numbers() const { return this->CornerNumbers; }

private:
  Buffer PointMemory, NumberMemory;
  std::span<TrianglePoints> Points;
  std::span<Numbers> CornerNumbers;
};

/** Collects the wall; returns the number of its triangles. */
std::int64_t readWall(const StoredMesh& mesh, const DistanceDescription& description,
  DistanceSources& sources, ScratchBlocks& to, DistanceRun& run, const std::string& name)
{
  const std::unique_ptr<MeshSource> source = sources.read(mesh);
  WallTriangles wall(to, sources, description.from.empty(), run.pool);
  const StreamCheck check = forCheckedBlocks(*source,
    [&](const MeshBlock& block)
    {
      wall.add(block);
      run.progress.update(0.0);
    });
  check.finish(mesh.info());
  wall.finish();
  sources.finish();
  run.report.vertices = check.vertices();
  run.report.cells = check.cells();
  noteUnwelded(CellType::Tetrahedron, check.vertices(), check.cells(), run.report);
  if (wall.count() == 0)
  {
    throw Error(name + ": no face of the boundary of the mesh is wall.");
  }
  return wall.count();
}

/** How many triangles there is memory for: a multiple of a block. */
std::int64_t partLength(std::int64_t triangles, const Pool& pool)
{
  constexpr std::int64_t Block = WallTriangles::BlockTriangles;
  const std::int64_t other = WallValues::ChunkVertices * WallValues::VertexBytes + (1 << 16);
  const std::int64_t room = pool.limit() - pool.used() - other;
  const std::int64_t most = room / WallPart::TriangleBytes / Block * Block;
  if (most < std::min(triangles, Block))
  {
    throw Error(memoryLimitSentence(
      pool.used() + other + Block * WallPart::TriangleBytes, pool.limit(), DistanceMemory));
  }
  return std::min(most, triangles);
}

void lowerAll(const StoredMesh& mesh, WallPass& pass, DistanceRun& run, tbb::task_arena& threads,
  double begin, double end)
{
  const std::unique_ptr<MeshSource> source = mesh.source({}, {});
  for (MeshBlock block; source->next(block);)
  {
    pass.add(block.positions, threads);
    const double done = static_cast<double>(block.firstVertex + block.vertices()) /
                        static_cast<double>(run.report.vertices);
    run.progress.update(begin + (end - begin) * done);
  }
  pass.finish(threads);
}

std::vector<StoredColumn> columnsOf(ScratchBlocks& values, const DistanceDescription& description)
{
  using Type = StoredColumn::Type;
  std::vector<StoredColumn> columns{ { &values, WallValues::Parts, WallValues::Distances,
    Type::Float64, 1, 0 } };
  if (description.source)
  {
    columns.push_back({ &values, WallValues::Parts, WallValues::Sources, Type::Int64, 1, 0 });
  }
  if (description.direction)
  {
    columns.push_back({ &values, WallValues::Parts, WallValues::Directions, Type::Float32, 3, 0 });
  }
  return columns;
}

} // namespace

std::unique_ptr<Solution> wallDistance(const StoredMesh& mesh,
  const DistanceDescription& description, std::unique_ptr<DistanceRun> run, const std::string& name)
{
  if (mesh.info().cellType != CellType::Tetrahedron)
  {
    throw Error("The distance to walls is that of a tetrahedral mesh, but this one has triangles.");
  }
  std::optional<DistanceSources> sources(
    std::in_place, description.from, DataPlace::Facets, mesh.info(), name, run->pool);
  auto files = std::make_shared<WallFiles>(*run);
  Report& report = run->report;
  report.distance = Report::Distance{};
  const Timer building;
  sources->prepare(mesh, run->scratch.path());
  const std::int64_t triangles =
    readWall(mesh, description, *sources, files->triangles, *run, name);
  sources.reset(); // and its memory
  report.distance->sources = triangles;
  report.seconds.build = building.seconds();
  tbb::task_arena threads(
    run->options.threads > 0 ? run->options.threads : tbb::info::default_concurrency());
  report.threads = threads.max_concurrency();
  const std::int64_t length = partLength(triangles, run->pool);
  const WallValues values{ files->values, description.source, description.direction };
  run->beginPasses();
  for (std::int64_t first = 0; first < triangles; first += length)
  {
    const auto share = [&](std::int64_t done)
    { return 0.2 + 0.8 * static_cast<double>(done) / static_cast<double>(triangles); };
    const std::int64_t count = std::min(length, triangles - first);
    WallPart part(run->pool, count);
    part.read(files->triangles, first);
    WallPass pass(part.points(), part.numbers(), first == 0, values, run->pool);
    lowerAll(mesh, pass, *run, threads, share(first), share(first + count));
    ++report.passes;
    run->endPass(1.0 - static_cast<double>(first + count) / static_cast<double>(triangles));
  }
  report.converged = true;
  report.distance->mesh_readings = report.passes;
  DistanceRun& shared = *run;
  auto solution = std::make_unique<DistanceSolution>(std::move(run), files,
    columnsOf(files->values, description), report.vertices, WallValues::ChunkVertices);
  solution->summarize();
  shared.progress.update(1.0);
  shared.finishReport();
  return solution;
}

} // namespace smg
