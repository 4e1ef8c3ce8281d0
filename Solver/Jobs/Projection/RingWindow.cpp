// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/RingWindow.h"

#include "Solver/Jobs/Projection/PointTree.h"
#include "smg/Error.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

// The part of a mesh stream within a number of edges of chosen vertices. A window of vertices and
// cells grows with the stream; forget() keeps what lies within the rings of the centers and of
// vertices that are not final, by a breadth-first walk. A final vertex outside of these cannot come
// within the rings any more, since all its edges are known and new centers are later vertices.
//
// At the end each center walks its rings once more and offers itself to the vertices there; the
// nearest one in space remains. Adding and forgetting take constant amortised time per cell; the
// last step takes the sum of the sizes of all rings.

namespace smg
{
namespace
{

/** The cells at each vertex: from begins[vertex] to begins[vertex + 1] in `cells`. */
struct Incidence
{
  std::vector<std::int64_t> begins;
  std::vector<std::int32_t> cells;
};

Incidence incidence(
  std::span<const std::int32_t> corners, std::size_t cornersOfCell, std::int64_t vertices)
{
  Incidence at;
  at.cells.resize(corners.size());
  // Counting sort: counts, then ends; filling backwards leaves the begins.
  at.begins.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const std::int32_t corner : corners)
  {
    ++at.begins[corner];
  }
  // `begins` has the end of each list now, and counts down to its begin below.
  std::int64_t end = 0;
  for (std::int64_t& begin : at.begins)
  {
    end += begin;
    begin = end;
  }
  for (std::size_t i = corners.size(); i-- > 0;)
  {
    at.cells[--at.begins[corners[i]]] = static_cast<std::int32_t>(i / cornersOfCell);
  }
  return at;
}

} // namespace

/** Lists the neighbours of each vertex by way of its cells. */
VertexGraph::VertexGraph(
  std::span<const std::int32_t> corners, int cornersOfCell, std::int64_t vertices)
{
  const auto count = static_cast<std::size_t>(cornersOfCell);
  const Incidence at = incidence(corners, count, vertices);
  // The vertex from which each vertex was last seen: finds repeated neighbours without sorting.
  std::vector<std::int32_t> lastSeenFrom(static_cast<std::size_t>(vertices), -1);
  this->Begins.reserve(static_cast<std::size_t>(vertices) + 1);
  this->Begins.push_back(0);
  // On a surface there are as many neighbours as corners, plus one for each boundary edge.
  this->Neighbours.reserve(corners.size() + corners.size() / 8);
  for (std::int32_t vertex = 0; vertex < vertices; ++vertex)
  {
    lastSeenFrom[vertex] = vertex;
    for (std::int64_t k = at.begins[vertex]; k < at.begins[vertex + 1]; ++k)
    {
      for (const std::int32_t other : corners.subspan(at.cells[k] * count, count))
      {
        if (std::exchange(lastSeenFrom[other], vertex) != vertex)
        {
          this->Neighbours.push_back(other);
        }
      }
    }
    this->Begins.push_back(static_cast<std::int64_t>(this->Neighbours.size()));
  }
}

/** A breadth-first walk, ring by ring; `found` is its queue as well as its result. */
std::size_t VertexGraph::walk(
  int rings, std::vector<std::int32_t>& found, std::vector<std::uint8_t>& isFound) const
{
  std::size_t begin = 0;
  std::size_t end = found.size();
  for (int ring = 0; ring < rings; ++ring)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      for (const std::int32_t next : this->neighbours(found[i]))
      {
        if (!isFound[next])
        {
          isFound[next] = 1;
          found.push_back(next);
        }
      }
    }
    begin = end;
    end = found.size();
  }
  return begin;
}

namespace
{

constexpr std::int64_t MaxPlaces = std::numeric_limits<std::int32_t>::max();

/** Bytes per vertex and per corner of a cell, in the window and in a VertexGraph together. */
constexpr std::int64_t BytesOfVertex = 64;
constexpr std::int64_t BytesOfCorner = 12;

/** The number of found vertices after which cancellation is checked. */
constexpr std::size_t FoundBetweenUpdates = 1 << 20;

/** Reserves room for more items, with less slack than vectors that double. */
template <class T>
void makeRoom(std::vector<T>& items, std::size_t more)
{
  const std::size_t size = items.size() + more;
  if (size > items.capacity())
  {
    items.reserve(std::max(size, items.size() + items.size() / 8));
  }
}

} // namespace

RingWindow::RingWindow(CellType cellType, int rings)
  : CornersOfCell(static_cast<std::size_t>(cornersOf(cellType)))
  , Rings(rings)
{
}

/** The stream index of the vertex at a place in the window. */
std::int64_t RingWindow::idOf(std::int64_t place) const
{
  const auto listed = static_cast<std::int64_t>(this->Listed.size());
  return place < listed ? this->Listed[place] : this->FirstRecent + place - listed;
}

/** The place of a vertex that the window has, by its stream index: recent ones are consecutive,
 * listed ones are found by bisection. */
std::int32_t RingWindow::placeOf(std::int64_t id) const
{
  const auto listed = static_cast<std::int64_t>(this->Listed.size());
  return static_cast<std::int32_t>(
    id >= this->FirstRecent
      ? listed + id - this->FirstRecent
      : std::lower_bound(this->Listed.begin(), this->Listed.end(), id) - this->Listed.begin());
}

std::span<const double, 3> RingWindow::positionAt(std::int32_t place) const
{
  return std::span(this->Positions).subspan(3 * static_cast<std::size_t>(place)).first<3>();
}

/** Appends the vertices and cells of a block, with places in the window for stream indices. */
void RingWindow::add(const MeshBlock& block)
{
  const auto corners = static_cast<std::int64_t>(block.corners.size() / this->CornersOfCell);
  // Places have 32 bits.
  if (this->vertices() + block.vertices() > MaxPlaces || this->cells() + corners > MaxPlaces)
  {
    throw Error("more than " + std::to_string(MaxPlaces) +
                " vertices or cells lie around the points of the region: give fewer rings, or a "
                "radius instead, or convert the mesh with the order bfs");
  }
  makeRoom(this->Positions, block.positions.size());
  makeRoom(this->Corners, block.corners.size());
  this->Positions.insert(this->Positions.end(), block.positions.begin(), block.positions.end());
  std::transform(block.corners.begin(), block.corners.end(), std::back_inserter(this->Corners),
    [this](std::int64_t corner) { return this->placeOf(corner); });
  this->Finalized = std::max(this->Finalized, block.finalized);
}

/** No vertex gets further neighbours. */
void RingWindow::finish()
{
  this->Finalized = this->idOf(this->vertices());
}

std::int64_t RingWindow::bytes() const
{
  return BytesOfVertex * this->vertices() +
         BytesOfCorner * static_cast<std::int64_t>(this->Corners.size());
}

VertexGraph RingWindow::graph() const
{
  return { this->Corners, static_cast<int>(this->CornersOfCell), this->vertices() };
}

/** Walks the rings of the centers and of all vertices that are not final, and discards the rest. */
void RingWindow::forget(std::span<const std::int64_t> centers)
{
  std::vector<std::int32_t> found;
  std::vector<std::uint8_t> isFound(static_cast<std::size_t>(this->vertices()), 0);
  const auto begin = [&](std::int32_t place)
  {
    if (!isFound[place])
    {
      isFound[place] = 1;
      found.push_back(place);
    }
  };
  for (const std::int64_t center : centers)
  {
    begin(this->placeOf(center));
  }
  const std::int64_t end = this->idOf(this->vertices());
  // Vertices that are not final may still get neighbours, through which a later center reaches
  // them.
  for (std::int64_t id = std::max(this->Finalized, this->FirstRecent); id < end; ++id)
  {
    begin(this->placeOf(id));
  }
  const std::size_t inner = this->graph().walk(this->Rings, found, isFound);

  // Cells with no vertex before the last ring have edges between vertices of that ring only, which
  // lead to no other vertex within the rings.
  std::vector<std::uint8_t> isInner(isFound.size(), 0);
  for (std::size_t i = 0; i < inner; ++i)
  {
    isInner[found[i]] = 1;
  }
  this->keepCells(isInner);
  const std::vector<std::int32_t> places = this->keepVertices(isFound);
  // Vertices of kept cells are kept: they are neighbours of an inner vertex, hence found.
  for (std::int32_t& corner : this->Corners)
  {
    corner = places[corner];
  }
}

/** Keeps the cells that have a marked vertex. */
void RingWindow::keepCells(const std::vector<std::uint8_t>& isInner)
{
  auto kept = this->Corners.begin();
  for (auto cell = this->Corners.begin(); cell != this->Corners.end();)
  {
    const auto end = cell + static_cast<std::ptrdiff_t>(this->CornersOfCell);
    const bool isKept =
      std::any_of(cell, end, [&isInner](std::int32_t corner) { return isInner[corner]; });
    kept = isKept ? std::copy(cell, end, kept) : kept;
    cell = end;
  }
  this->Corners.erase(kept, this->Corners.end());
}

/** Keeps the marked vertices, which must include all that are not final, in their order. Returns
 * the new place of each; -1: none. */
std::vector<std::int32_t> RingWindow::keepVertices(const std::vector<std::uint8_t>& isKept)
{
  std::vector<std::int32_t> places(isKept.size(), -1);
  std::vector<std::int64_t> listed;
  std::int32_t kept = 0;
  for (std::size_t place = 0; place < isKept.size(); ++place)
  {
    if (isKept[place])
    {
      const std::int64_t id = this->idOf(static_cast<std::int64_t>(place));
      if (id < this->Finalized)
      {
        listed.push_back(id);
      }
      std::copy_n(this->Positions.begin() + 3 * static_cast<std::ptrdiff_t>(place), 3,
        this->Positions.begin() + 3 * static_cast<std::ptrdiff_t>(kept));
      places[place] = kept++;
    }
  }
  this->FirstRecent = std::max(this->FirstRecent, this->Finalized);
  this->Positions.resize(3 * static_cast<std::size_t>(kept));
  this->Listed = std::move(listed);
  return places;
}

/** The nearest center of each vertex of the window, of those whose rings contain it. */
std::vector<RingWindow::Nearest> RingWindow::nearestAtPlaces(
  std::span<const std::int64_t> centers, Progress& progress) const
{
  // By place, so that consecutive walks find their data in the cache.
  std::vector<std::pair<std::int32_t, std::int64_t>> sorted;
  for (std::size_t k = 0; k < centers.size(); ++k)
  {
    sorted.emplace_back(this->placeOf(centers[k]), static_cast<std::int64_t>(k));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<Nearest> nearest(static_cast<std::size_t>(this->vertices()));
  std::vector<std::uint8_t> isFound(nearest.size(), 0);
  std::vector<std::int32_t> found;
  const VertexGraph graph = this->graph();
  std::size_t steps = 0;
  std::int32_t last = -1;
  for (const auto& [place, center] : sorted)
  {
    // Several centers at one vertex have the same rings and distances: the first one counts.
    if (std::exchange(last, place) == place)
    {
      continue;
    }
    found.assign(1, place);
    isFound[place] = 1;
    graph.walk(this->Rings, found, isFound);
    for (const std::int32_t vertex : found)
    {
      // Cleared along the walk, which costs less than clearing the whole window.
      isFound[vertex] = 0;
      const double squared =
        PointTree::squaredDistance(this->positionAt(place), this->positionAt(vertex));
      Nearest& best = nearest[vertex];
      if (best.center < 0 || squared < best.squaredDistance ||
          (squared == best.squaredDistance && center < best.center))
      {
        best = { center, squared };
      }
    }
    steps += found.size();
    if (steps >= FoundBetweenUpdates)
    {
      progress.update(0.0);
      steps = 0;
    }
  }
  return nearest;
}

/** Only vertices that some ring reaches, with their stream indices: places are in this order
 * already. */
std::vector<std::pair<std::int64_t, std::int64_t>> RingWindow::nearestCenters(
  std::span<const std::int64_t> centers, Progress& progress) const
{
  const std::vector<Nearest> nearest = this->nearestAtPlaces(centers, progress);
  const auto isReached = [](const Nearest& at) { return at.center >= 0; };
  std::vector<std::pair<std::int64_t, std::int64_t>> reached;
  reached.reserve(
    static_cast<std::size_t>(std::count_if(nearest.begin(), nearest.end(), isReached)));
  for (std::size_t place = 0; place < nearest.size(); ++place)
  {
    if (isReached(nearest[place]))
    {
      reached.emplace_back(this->idOf(static_cast<std::int64_t>(place)), nearest[place].center);
    }
  }
  return reached;
}

} // namespace smg
