// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/WallDistance.h"

#include "Solver/Jobs/Distance/DistanceRun.h"
#include "Solver/Jobs/Distance/WallPass.h"
#include "Solver/Mesh/StreamCheck.h"
#include "smg/Error.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

// The Euclidean distance to walls. One reading of the mesh collects the wall triangles on a scratch
// file. They are then taken in parts that fit into the memory limit, as a rule all at once; a pass
// over the vertices for each part lowers their distances, if one of its triangles is nearer.
//
// Distances are compared, not their squares, and of equally near triangles the first one counts:
// therefore the result has the same bits for any number of parts and threads, and any blocks.
//
// Memory: 116 bytes per triangle of a part, and a chunk of vertices. Time: about logarithmic in the
// number of triangles for each vertex and part.

namespace smg
{

namespace
{

/** The scratch files of the triangles and of the distances. */
struct WallFiles
{
  explicit WallFiles(DistanceRun& run)
    : triangles(run.options.scratch / "wall", run.traffic.add("wall"))
    , values(run.options.scratch / "distances", run.traffic.add("distances"))
  {
  }
  BlockStore triangles, values;
};

/** Reads the mesh and collects the wall; returns the number of its triangles. */
std::int64_t readWall(const StoredMesh& mesh, const DistanceDescription& description,
  DistanceSources& sources, BlockStore& to, DistanceRun& run, const std::string& name)
{
  const std::unique_ptr<MeshSource> source = sources.read(mesh);
  // Without a selection, all of the boundary is wall.
  WallTriangles wall(to, sources, description.from.empty(), run.pool);
  const StreamCheck check = forCheckedBlocks(*source,
    [&](const MeshBlock& block)
    {
      wall.add(block);
      // The progress does not advance, but may cancel.
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
    throw Error(name + ": no face of the boundary or of a group of the mesh is wall.");
  }
  return wall.count();
}

/** A pass over all vertices, with a part of the wall; progress goes from `begin` to `end`. */
void lowerAll(const StoredMesh& mesh, WallPass& pass, DistanceRun& run, Workers& threads,
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

/** The columns of the solution, in the order of distanceColumns(), and where they are stored. */
std::vector<StoredColumn> columnsOf(BlockStore& values, const DistanceDescription& description)
{
  using Type = StoredColumn::Type;
  // Every block is written, so there are no values to fall back to.
  std::vector<StoredColumn> columns{ { &values, WallValues::Parts, WallValues::Distances,
    Type::Float64, 1, 0 } };
  if (description.source)
  {
    columns.push_back({ &values, WallValues::Parts, WallValues::Sources, Type::Int64, 1, 0,
      description.group ? numberOfLabel : nullptr });
  }
  if (description.group)
  {
    columns.push_back(
      { &values, WallValues::Parts, WallValues::Sources, Type::Int64, 1, 0, groupOfLabel });
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
  std::optional<DistanceSources> sources(std::in_place, description.from, DataPlace::Facets,
    description.group, mesh.info(), name, run->pool);
  auto files = std::make_shared<WallFiles>(*run);
  Report& report = run->report;
  report.distance = Report::Distance{};
  const Timer building;
  sources->prepare(mesh, run->options.scratch);
  const std::int64_t triangles =
    readWall(mesh, description, *sources, files->triangles, *run, name);
  // Gives its memory back to the triangles.
  sources.reset();
  report.distance->exact = true;
  report.distance->sources = triangles;
  report.seconds.build = building.seconds();
  Workers threads(run->options.threads);
  report.threads = threads.threads();
  // Fixed for all parts, once the memory of the selections has been given back.
  const std::int64_t length = TrianglePart::lengthFor(
    triangles, WallValues::ChunkVertices * WallValues::VertexBytes, run->pool);
  const WallValues values{ files->values, description.source || description.group,
    description.direction };
  run->beginPasses();
  for (std::int64_t first = 0; first < triangles; first += length)
  {
    // Collecting the wall counts as a fifth of the work.
    const auto share = [&](std::int64_t done)
    { return 0.2 + 0.8 * static_cast<double>(done) / static_cast<double>(triangles); };
    const std::int64_t count = std::min(length, triangles - first);
    // The first pass sets the values, later ones lower them.
    const TrianglePart part(files->triangles, first, count, run->pool);
    WallPass pass(part, first == 0, values, run->pool);
    lowerAll(mesh, pass, *run, threads, share(first), share(first + count));
    ++report.passes;
    run->endPass(1.0 - static_cast<double>(first + count) / static_cast<double>(triangles));
  }
  report.converged = true;
  report.distance->mesh_readings = report.passes;
  auto solution = std::make_unique<DistanceSolution>(std::move(run), files,
    columnsOf(files->values, description), report.vertices, WallValues::ChunkVertices);
  solution->finish();
  return solution;
}

} // namespace smg
