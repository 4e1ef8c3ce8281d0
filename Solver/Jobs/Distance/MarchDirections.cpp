// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/MarchDirections.h"

#include <algorithm>
#include <cmath>
#include <limits>

// The gradient of a distance at each vertex, in one pass over the chunks after the march: the
// direction in which the shortest path arrives. The march keeps no paths. They are found again
// here: of all cells of a vertex and all their facets, the one through which the shortest path
// comes, by the same formulas (Arrival.h).
//
// Each vertex sees its cells in the order of the stream, and the first of equally short paths
// counts. Two chunks are shown at a time; the cost is one update per corner of each cell.

namespace smg
{

namespace
{

constexpr std::int64_t VertexBytes = sizeof(double) + 3 * sizeof(float);

/** A path to a vertex, and the point where it crosses the facet opposite to that. */
struct Path
{
  double distance = std::numeric_limits<double>::infinity();
  Vector crossing{};
};

/** The point a + x (b - a) + y (c - a); c is not needed if y is 0. */
Vector pointOf(const FrontCorner* const* corners, const double (&weight)[2])
{
  Vector point{ corners[0]->point[0], corners[0]->point[1], corners[0]->point[2] };
  for (int n = 0; n < 2 && weight[n] != 0; ++n)
  {
    for (int k = 0; k < 3; ++k)
    {
      point[k] += weight[n] * (corners[n + 1]->point[k] - corners[0]->point[k]);
    }
  }
  return point;
}

/** The shortest path to w through the inside of the facet of N corners. */
template <int N>
Path throughInside(const double* w, const FrontCorner* const* corners)
{
  const Vector to = difference(w, corners[0]->point);
  Arrival arrival;
  // The frames have corners[0] as their origin, like those of the march.
  if constexpr (N == 1)
  {
    arrival = fromCorner(*corners[0], std::sqrt(dot(to, to)));
  }
  else
  {
    const Vector e = difference(corners[1]->point, corners[0]->point);
    if constexpr (N == 2)
    {
      arrival = acrossEdge({ dot(e, e), dot(e, to), dot(to, to) }, *corners[0], *corners[1]);
    }
    else
    {
      const Vector f = difference(corners[2]->point, corners[0]->point);
      arrival = acrossFace({ dot(e, e), dot(e, f), dot(f, f), dot(e, to), dot(f, to), dot(to, to) },
        *corners[0], *corners[1], *corners[2]);
    }
  }
  return { arrival.distance, pointOf(corners, arrival.weight) };
}

/** The shortest path to w through the facet of N corners: through its inside or, if none crosses
 * that, through one of its own facets, down to single corners. */
template <int N>
Path through(const double* w, const FrontCorner* const* corners)
{
  const auto isReached = [](const FrontCorner* corner) { return std::isfinite(corner->distance); };
  Path path;
  const auto isOfOneSource = [&](const FrontCorner* corner)
  { return corner->source == corners[0]->source; };
  if (std::all_of(corners, corners + N, isReached) &&
      std::all_of(corners, corners + N, isOfOneSource))
  {
    path = throughInside<N>(w, corners);
  }
  if constexpr (N > 1)
  {
    // A path through the inside is at most as long as a path through the boundary of the facet. If
    // a corner has not been reached, there is no path through the inside, but perhaps one through
    // the others.
    const bool isInside = std::isfinite(path.distance);
    for (int k = 0; k < N && !isInside; ++k)
    {
      const FrontCorner* others[N - 1];
      std::copy(corners + k + 1, corners + N, std::copy_n(corners, k, others));
      const Path other = through<N - 1>(w, others);
      path = other.distance < path.distance ? other : path;
    }
  }
  return path;
}

} // namespace

MarchDirections::MarchDirections(ChunkedMesh& mesh, Pool& pool)
  : Window(mesh, pool)
{
  const std::int64_t vertices = std::min(mesh.plan.window(), mesh.vertices);
  this->Memory = Buffer(pool, static_cast<std::size_t>(vertices * VertexBytes));
  this->Shortest = reinterpret_cast<double*>(this->Memory.data());
  this->Direction = reinterpret_cast<float*>(this->Shortest + vertices);
}

std::int64_t MarchDirections::bytes(
  const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells, std::int64_t crossingCells)
{
  return MarchWindow::bytes(plan, vertices, innerCells, crossingCells) +
         std::min(plan.window(), vertices) * VertexBytes;
}

template <int Corners>
void MarchDirections::addCells(std::span<const std::uint32_t> corners)
{
  for (; !corners.empty(); corners = corners.subspan(Corners))
  {
    FrontCorner all[Corners];
    for (int k = 0; k < Corners; ++k)
    {
      all[k] = { this->Window.point(corners[k]), this->Window.distance()[corners[k]],
        (this->Window.flags()[corners[k]] & Straight) != 0, this->Window.frontSource(corners[k]) };
    }
    for (int k = 0; k < Corners; ++k)
    {
      const std::uint32_t w = corners[k];
      // Sources and vertices that are not reached keep the direction 0.
      if (all[k].distance == 0 || !std::isfinite(all[k].distance))
      {
        continue;
      }
      const FrontCorner* others[Corners - 1];
      for (int n = 1; n < Corners; ++n)
      {
        others[n - 1] = &all[(k + n) % Corners];
      }
      // From where the path crosses the facet to the corner: the direction in which it arrives.
      const Path path = through<Corners - 1>(all[k].point, others);
      const Vector along = difference(all[k].point, path.crossing.data());
      const double length = std::sqrt(dot(along, along));
      // Coincident vertices give no direction.
      if (path.distance < this->Shortest[w] && length > 0)
      {
        this->Shortest[w] = path.distance;
        std::ranges::transform(along, this->Direction + 3 * std::size_t(w),
          [length](double part) { return static_cast<float>(part / length); });
      }
    }
  }
}

/** Starts the vertices of the chunk, and adds all cells whose last corner it has: they may also
 * improve vertices of the chunk before. */
void MarchDirections::addChunk(std::int64_t chunk)
{
  const ChunkedMesh& mesh = this->Window.mesh();
  const auto place = static_cast<std::size_t>(this->Window.placeOf(chunk));
  const auto count = static_cast<std::size_t>(mesh.countOf(chunk));
  // The places may have belonged to another chunk before.
  std::fill_n(this->Shortest + place, count, std::numeric_limits<double>::infinity());
  std::fill_n(this->Direction + 3 * place, 3 * count, 0.0F);
  for (const std::span<const std::uint32_t> cells :
    { this->Window.innerCells(chunk), this->Window.crossingCells(chunk) })
  {
    mesh.plan.cellType == CellType::Triangle ? this->addCells<3>(cells) : this->addCells<4>(cells);
  }
}

/** Moves forward over the stream, with one chunk and the one before it in the window. */
void MarchDirections::write(BlockStore& to, Progress& progress)
{
  const ChunkedMesh& mesh = this->Window.mesh();
  for (std::int64_t chunk = 0; chunk < mesh.count(); ++chunk)
  {
    this->Window.show(std::max<std::int64_t>(chunk - 1, 0), chunk);
    this->addChunk(chunk);
    // Cells reach no farther back than one chunk: the cells of this chunk complete the one before.
    // The last chunk is complete with its own.
    for (std::int64_t done = chunk - 1; done <= chunk; ++done)
    {
      if (done >= 0 && (done < chunk || chunk + 1 == mesh.count()))
      {
        to.write(done,
          std::as_bytes(std::span(this->Direction + 3 * std::size_t(this->Window.placeOf(done)),
            3 * static_cast<std::size_t>(mesh.countOf(done)))));
      }
    }
    progress.update(0.0);
  }
}

} // namespace smg
