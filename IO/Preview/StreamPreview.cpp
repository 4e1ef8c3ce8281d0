// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/StreamPreview.h"

#include "IO/Mesh/Columns.h"
#include "IO/Preview/SolidPreview.h"
#include "IO/Results/VertexNormals.h"
#include "IO/Simplification/Bodies.h"
#include "IO/Simplification/EdgeCollapse.h"
#include "IO/Simplification/SolidBoundary.h"
#include "IO/Simplification/StreamSimplifier.h"
#include "IO/Simplification/VertexClusters.h"
#include "IO/Simplification/WindowSize.h"
#include "Solver/Core/Progress.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <vector>

namespace smg
{
namespace
{

/** Meshes of more cells are simplified on all cores. */
constexpr std::int64_t CellsOfOneThread = 4000000;

/** Memory with which the preview is simplified as a whole at the end, and with which parts of the
 * stream have vertices that others do not have. */
std::int64_t memoryFor(std::int64_t points, const StreamInfo& info)
{
  constexpr std::int64_t OfPoint = 3500, OfWidth = 10000; // bytes
  constexpr std::int64_t Least = std::int64_t(32) << 20, Most = std::int64_t(320) << 20;
  const std::int64_t width = info.width < 0 ? 10000 : info.width;
  return std::max(OfPoint * points, std::clamp(OfWidth * width, Least, Most));
}

/** Appends a part; vertices that several parts have are repeated. */
void append(const SurfacePart& from, SurfacePart& to)
{
  const auto first = static_cast<std::uint32_t>(to.vertices());
  to.ids.insert(to.ids.end(), from.ids.begin(), from.ids.end());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  to.rows.insert(to.rows.end(), from.rows.begin(), from.rows.end());
  std::ranges::transform(from.corners, std::back_inserter(to.corners),
    [first](std::uint32_t corner) { return first + corner; });
}

/** The surface with its vertices by ascending stream index, each once. */
MeshPiece pieceOf(const SurfacePart& surface, const std::vector<ColumnSpec>& columns)
{
  std::vector<std::uint32_t> order(surface.vertices());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t v) { return surface.ids[v]; });
  MeshPiece piece;
  piece.vertexColumns = emptyColumns(columns);
  std::vector<std::int64_t> places(order.size());
  for (const std::uint32_t v : order)
  {
    if (piece.ids.empty() || piece.ids.back() != surface.ids[v])
    {
      piece.ids.push_back(surface.ids[v]);
      surface.copyVertex(v, piece.positions, piece.vertexColumns);
    }
    places[v] = piece.vertices() - 1;
  }
  std::ranges::transform(surface.corners, std::back_inserter(piece.corners),
    [&places](std::uint32_t corner) { return places[corner]; });
  piece.normals = unitNormals(normalSums({ piece.positions, piece.corners, {} }));
  piece.ghost.assign(piece.ids.size(), 0);
  piece.finalized.assign(piece.ids.size(), 1);
  return piece;
}

/** The values of a column at the vertices `ids`, ascending, read in ranges of several vertices. */
Column gather(VsmReader& mesh, const ColumnSpec& spec, const std::vector<std::int64_t>& ids)
{
  constexpr std::int64_t stretch = 16384;
  const std::size_t size = spec.tupleBytes();
  Column gathered{ spec, {} };
  gathered.resize(ids.size());
  Column rows;
  for (std::size_t begin = 0; begin < ids.size();)
  {
    const std::int64_t first = ids[begin];
    std::size_t end = begin;
    while (end < ids.size() && ids[end] < first + stretch)
    {
      ++end;
    }
    mesh.readVertexColumn(spec.name, first, ids[end - 1] + 1 - first, rows);
    for (; begin < end; ++begin)
    {
      std::memcpy(gathered.bytes.data() + begin * size,
        rows.bytes.data() + (ids[begin] - first) * size, size);
    }
  }
  return gathered;
}

/** Of the vertices that are left in the surface: whether they are locked. */
std::vector<std::uint8_t> lockedOf(const SurfacePart& surface, std::span<const std::uint8_t> locked)
{
  std::vector<std::uint8_t> left(surface.vertices());
  std::ranges::transform(surface.ids, left.begin(),
    [&locked](std::int64_t id) { return locked[static_cast<std::size_t>(id)]; });
  return left;
}

} // namespace

MeshPiece makePreview(MeshSource& mesh, std::int64_t maximumPoints,
  const ProgressFunction& progress, std::int64_t maxMemory, std::vector<std::string>* notes)
{
  Progress done(progress);
  Workers workers(mesh.info().cells > CellsOfOneThread ? 0 : 1);
  SolidBoundary triangles(mesh);
  StreamSimplifier simplifier(triangles, false, { .vertices = maximumPoints },
    std::min(memoryFor(maximumPoints, mesh.info()), maxMemory), workers,
    [&done](double share) { done.update(share); });
  SurfacePart surface;
  for (StreamSimplifier::Result result; simplifier.next(result);)
  {
    append(result.surface, surface);
  }
  if (notes)
  {
    noteBodies(simplifier, *notes);
    noteShape(simplifier, false, *notes);
  }
  done.update(1.0);
  return pieceOf(surface, mesh.info().vertexColumns);
}

JobEstimate previewEstimate(const EstimatedInput& mesh, std::int64_t maximumPoints,
  const std::filesystem::path& out, bool text, const ConversionOptions& conversion)
{
  constexpr double SecondsOfCell = 1.3e-6; // on a machine of 2023
  StreamInfo surface = mesh.info;
  surface.cellColumns.clear();
  surface.cells = mesh.info.cellType == CellType::Triangle ? surface.cells : 0; // not known
  Costs costs;
  costs.memory = windowBytes(memoryFor(maximumPoints, mesh.info), surface) + openBytes(surface);
  costs.passes = 1;
  costs.seconds = SecondsOfCell * static_cast<double>(mesh.info.cells);
  EstimatedInput result = mesh;
  result.parts.clear();
  result.info.cellType = CellType::Triangle;
  result.info.cellColumns.clear();
  result.info.vertices = std::min(result.info.vertices, maximumPoints);
  result.info.cells = std::min(result.info.cells, 2 * result.info.vertices);
  const ColumnSpec streamIndex{ StreamIndexName, ScalarType::Int64, 1 };
  JobEstimate estimate(result,
    { .out = out, .added = { { streamIndex, OriginalIdSpec }, {} }, .text = text }, costs,
    conversion);
  estimate.vertices = mesh.info.vertices;
  estimate.cells = mesh.info.cells;
  estimate.memory_limit = std::max(conversion.memoryLimit, estimate.memory_bytes);
  return estimate;
}

MeshPiece makePreviewPiece(VsmReader& mesh, std::int64_t maximumPoints,
  const ProgressFunction& progress, SolidPreviewCells cells, std::vector<std::string>* notes)
{
  const std::vector<ColumnSpec>& columns = mesh.info().vertexColumns;
  if (cells != SolidPreviewCells::Tetrahedra || mesh.info().cellType != CellType::Tetrahedron)
  {
    return makePreview(*mesh.source(columnNames(columns), {}), maximumPoints, progress,
      std::numeric_limits<std::int64_t>::max(), notes);
  }
  // Most rows are not needed, so the columns are read afterwards.
  MeshPiece piece = makeSolidPreview(mesh, maximumPoints, progress);
  for (const ColumnSpec& spec : columns)
  {
    piece.vertexColumns.push_back(gather(mesh, spec, piece.ids));
  }
  return piece;
}

std::string emptyPreview(std::int64_t maximumPoints)
{
  return "a preview of at most " + std::to_string(maximumPoints) +
         " points shows nothing of this mesh: its cells repeat a corner or one another.";
}

CoarserSurface coarserSurface(std::span<const double> points, std::span<const std::int64_t> corners,
  std::span<const std::uint8_t> locked, std::int64_t most)
{
  SurfacePart surface;
  surface.points.assign(points.begin(), points.end());
  surface.ids.resize(points.size() / 3);
  std::iota(surface.ids.begin(), surface.ids.end(), 0);
  std::ranges::transform(corners, std::back_inserter(surface.corners),
    [](std::int64_t corner) { return static_cast<std::uint32_t>(corner); });
  surface.dropUnusedVertices();

  const auto wanted = static_cast<std::size_t>(
    most + std::ranges::count_if(locked, [](std::uint8_t is) { return is != 0; }));
  const bool mayBe = mayBeFragments(
    static_cast<std::int64_t>(surface.vertices()), static_cast<std::int64_t>(surface.triangles()));
  SmallBodies bodies = smallBodies(surface, lockedOf(surface, locked), most, mayBe);
  if (bodies.number > 0)
  {
    collapseFlat(surface, lockedOf(surface, locked), wanted);
    bodies = smallBodies(surface, lockedOf(surface, locked), most, mayBe);
  }
  removeBodies(surface, bodies);
  if (!bodies.areFragments && surface.vertices() > wanted)
  {
    collapseEdges(surface, lockedOf(surface, locked), { .vertices = wanted, .mayCut = true });
  }
  if (surface.vertices() > wanted + wanted / 4)
  {
    clusterVertices(surface, {}, wanted); // its edges cannot be collapsed
  }
  CoarserSurface coarser;
  std::vector<std::uint32_t> order(surface.vertices());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t v) { return surface.ids[v]; });
  std::vector<std::int64_t> places(order.size());
  for (const std::uint32_t v : order)
  {
    places[v] = static_cast<std::int64_t>(coarser.vertices.size());
    coarser.vertices.push_back(surface.ids[v]);
  }
  std::ranges::transform(surface.corners, std::back_inserter(coarser.corners),
    [&places](std::uint32_t corner) { return places[corner]; });
  return coarser;
}

} // namespace smg
