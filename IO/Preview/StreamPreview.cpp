// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/StreamPreview.h"

#include "IO/Formats/Vsm/Columns.h"
#include "IO/Simplification/SolidBoundary.h"
#include "IO/Simplification/StreamSimplifier.h"
#include "Solver/Core/Progress.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/** The normals of the vertices: the means of those of the triangles, weighted by their angles. */
std::vector<float> normalsOf(const MeshPiece& piece)
{
  using Vector = Eigen::Vector3d;
  const auto point = [&piece](std::int64_t v)
  { return Eigen::Map<const Vector>(piece.positions.data() + 3 * v); };
  std::vector<double> sums(piece.positions.size());
  for (std::size_t i = 0; i < piece.corners.size(); i += 3)
  {
    const std::int64_t* c = piece.corners.data() + i;
    const Vector normal =
      (point(c[1]) - point(c[0])).cross(point(c[2]) - point(c[0])).stableNormalized();
    for (int k = 0; k < 3; ++k)
    {
      const Vector a = (point(c[(k + 1) % 3]) - point(c[k])).stableNormalized();
      const Vector b = (point(c[(k + 2) % 3]) - point(c[k])).stableNormalized();
      Eigen::Map<Vector>(sums.data() + 3 * c[k]) +=
        std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * normal;
    }
  }
  std::vector<float> normals(sums.size());
  for (std::size_t i = 0; i < sums.size(); i += 3)
  {
    const Vector normal = Eigen::Map<const Vector>(sums.data() + i).stableNormalized();
    Eigen::Map<Eigen::Vector3f>(normals.data() + i) = normal.cast<float>();
  }
  return normals;
}

/** The surface with its vertices by ascending stream index, each once. */
MeshPiece pieceOf(const SurfacePart& surface, const std::vector<ColumnSpec>& columns)
{
  std::vector<std::uint32_t> order(surface.vertices());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t v) { return surface.ids[v]; });
  MeshPiece piece;
  piece.vertexColumns = emptyColumns(columns);
  const std::size_t row = surface.rowBytes();
  std::vector<std::int64_t> places(order.size());
  for (const std::uint32_t v : order)
  {
    if (piece.ids.empty() || piece.ids.back() != surface.ids[v])
    {
      piece.ids.push_back(surface.ids[v]);
      const auto point = surface.points.begin() + 3 * static_cast<std::ptrdiff_t>(v);
      piece.positions.insert(piece.positions.end(), point, point + 3);
      const std::byte* from = surface.rows.data() + v * row;
      for (Column& column : piece.vertexColumns)
      {
        column.bytes.insert(column.bytes.end(), from, from + column.spec.tupleBytes());
        from += column.spec.tupleBytes();
      }
    }
    places[v] = piece.vertices() - 1;
  }
  std::ranges::transform(surface.corners, std::back_inserter(piece.corners),
    [&places](std::uint32_t corner) { return places[corner]; });
  piece.normals = normalsOf(piece);
  piece.ghost.assign(piece.ids.size(), 0);
  piece.finalized.assign(piece.ids.size(), 1);
  return piece;
}

} // namespace

MeshPiece makePreview(
  MeshSource& mesh, std::int64_t maximumPoints, const ProgressFunction& progress)
{
  Progress done(progress);
  Workers workers(mesh.info().cells > CellsOfOneThread ? 0 : 1);
  SolidBoundary triangles(mesh);
  StreamSimplifier simplifier(triangles, { .vertices = maximumPoints },
    memoryFor(maximumPoints, mesh.info()), workers, [&done](double share) { done.update(share); });
  SurfacePart surface;
  for (StreamSimplifier::Result result; simplifier.next(result);)
  {
    append(result.surface, surface);
  }
  done.update(1.0);
  return pieceOf(surface, mesh.info().vertexColumns);
}

std::string emptyPreview(std::int64_t maximumPoints)
{
  return "a preview of at most " + std::to_string(maximumPoints) +
         " points shows nothing of this mesh: its cells repeat a corner or one another.";
}

} // namespace smg
