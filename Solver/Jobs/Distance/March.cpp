// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/March.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// The march of the front of a distance, |grad d| = 1, through a mesh in chunks (docs/distance.md,
// "Method"): fast marching in its label-correcting form. A vertex that is taken from the queue
// offers to the other corners of its cells the distances of paths that cross the facets of already
// reached corners (Arrival.h); a vertex that gets a shorter path is put into the queue, again if
// need be. Fast marching needs the order of distances to be final, which obtuse triangles and a
// window violate; correction only needs more updates then.
//
// Invariants. A vertex is dirty if some of its cells have not seen its current distance; the march
// is complete when none is. Distances never grow, and an update depends only on the distances that
// it finds, so that the order of updates and the window matter no more than rounding and the
// tolerance. The order itself depends on neither the memory limit nor the blocks of the stream, and
// there is one thread: so the result has the same bits whatever these are.
//
// Memory: four chunks with their cells, and the queue. Time: on scans and tetrahedral meshes 1 to 6
// passes over the stream, in which positions of the window without dirty vertices are skipped; a
// path that winds through the stream takes one for each turn against the direction.

namespace smg
{

namespace
{

constexpr double Infinite = std::numeric_limits<double>::infinity();

/** Directions count as perpendicular if the magnitude of their cosine is at most this. */
constexpr double Perpendicular = 1e-6;
/** A path is a straight line if it is longer by at most this share. */
constexpr double Straightness = 1e-9;
/** What a line from a vertex at which the path turns must be shorter by, relative to its length:
 * the place of the turn is not exact. */
constexpr double LeastGain = 1e-3;

} // namespace

template <int Corners>
void March::settle(std::int64_t first, std::int64_t last)
{
  const ChunkedMesh& mesh = this->Window.mesh();
  std::uint8_t* flags = this->Window.flags();
  const double* distances = this->Window.distance();
  // All dirty vertices at once, so that fronts that enter from different sides meet in the order of
  // their distances.
  for (std::int64_t chunk = first; chunk <= last; ++chunk)
  {
    const std::uint32_t begin = this->Window.placeOf(chunk);
    const auto end = begin + static_cast<std::uint32_t>(mesh.countOf(chunk));
    for (std::uint32_t v = begin; v < end && mesh.chunks[std::size_t(chunk)].dirty > 0; ++v)
    {
      if ((flags[v] & Dirty) != 0)
      {
        this->Queue.put(v, distances[v]);
      }
    }
  }
  this->Sight.forget();
  while (!this->Queue.isEmpty())
  {
    // Some position of the window has all cells of v: these are in its chunk and the two beside it.
    const std::uint32_t v = this->Queue.take();
    this->count();
    const bool hasAll = this->Window.hasAllCellsOf(v);
    if (!hasAll && distances[v] == 0)
    {
      // Which of its cells have other sources must be known: see isBesideCurve().
      continue;
    }
    // Otherwise v passes its distance on to the cells that are here, and stays dirty for the
    // others. Every position of the window that lacks some of its cells does that again, which
    // changes nothing a second time.
    flags[v] |= Changed;
    if (hasAll)
    {
      flags[v] &= static_cast<std::uint8_t>(~Dirty);
    }
    this->Window.forCellsOf<Corners>(v,
      [&](const std::uint32_t* cell)
      {
        // Collects the other corners without a branch, since it cannot be predicted which corner v
        // is. The last element is not used.
        std::array<std::uint32_t, Corners> others;
        std::size_t k = 0;
        for (int c = 0; c < Corners; ++c)
        {
          others[k] = cell[c];
          k += cell[c] != v ? 1 : 0;
        }
        this->passOn(v, others);
      });
  }
}

void March::settle(std::int64_t first, std::int64_t last)
{
  const bool triangles = this->Window.mesh().plan.cellType == CellType::Triangle;
  triangles ? this->settle<3>(first, last) : this->settle<4>(first, last);
}

void March::count()
{
  constexpr std::int64_t Often = 1 << 14;
  if (++this->Taken % Often == 0)
  {
    this->poll();
  }
  if (this->Taken > MostTaken * this->Window.mesh().vertices)
  {
    this->Tolerance *= 10;
    this->Taken = 0;
  }
}

FrontCorner March::corner(std::uint32_t vertex) const
{
  return { this->Window.point(vertex), this->Window.distance()[vertex],
    (this->Window.flags()[vertex] & Straight) != 0 };
}

bool March::isNews(std::uint32_t w, const Arrival& arrival) const
{
  if (arrival.distance > this->Within)
  {
    return false;
  }
  const double distance = this->Window.distance()[w];
  // Of two fronts that arrive at the same time, within the tolerance, the straight one wins.
  const bool isStraighter = arrival.isStraight && (this->Window.flags()[w] & Straight) == 0 &&
                            arrival.distance < distance * (1 + this->Tolerance);
  return arrival.distance < distance * (1 - this->Tolerance) || isStraighter;
}

template <std::size_t N>
bool March::offer(std::uint32_t w, Arrival arrival, const std::array<std::uint32_t, N>& corners)
{
  if (this->Window.hasNearest())
  {
    arrival.distance = std::max(arrival.distance, this->Window.nearest(w).distance);
  }
  if (!this->isNews(w, arrival))
  {
    // A distance that is shorter by less than the tolerance is not passed on, but it may have quite
    // another direction.
    const bool isStraight = (this->Window.flags()[w] & Straight) != 0;
    if (arrival.distance <= this->Within && arrival.distance < this->Window.distance()[w] &&
        arrival.isStraight == isStraight && this->haveOneSource(w, corners[0]))
    {
      this->Window.distance()[w] = arrival.distance;
      this->Window.flags()[w] |= Changed;
      this->arrive(w, arrival, corners);
    }
    return true;
  }
  // A path across a facet with a corner that the front reached by way of w would come from w
  // itself. Along an edge, such a path is longer than the distance of w, and has not passed
  // isNews().
  for (const std::uint32_t corner : corners)
  {
    const auto& via = this->Window.via()[corner];
    if (N > 1 && std::find(via.begin(), via.end(), w) != via.end())
    {
      return false;
    }
  }
  this->arrive(w, arrival, corners);
  std::array<std::uint32_t, 3> via;
  std::fill(
    std::copy(corners.begin(), corners.end(), via.begin()), via.end(), MarchWindow::NoVertex);
  // The path belongs to the source of the corner that it passes nearest to.
  this->accept(w, arrival, corners[static_cast<std::size_t>(arrival.nearestCorner())], via);
  return true;
}

void March::accept(std::uint32_t w, const Arrival& arrival, std::uint32_t passed,
  const std::array<std::uint32_t, 3>& via)
{
  double& distance = this->Window.distance()[w];
  std::uint8_t& flags = this->Window.flags()[w];
  // A straight front may win with a distance that is larger by up to the tolerance; distances must
  // not grow.
  distance = std::min(distance, arrival.distance);
  flags = static_cast<std::uint8_t>((flags & ~(Straight | OfRegion)) | Dirty | Changed |
                                    (arrival.isStraight ? Straight : 0) |
                                    (this->Window.flags()[passed] & OfRegion));
  this->Window.via()[w] = via;
  if (std::int64_t* source = this->Window.source())
  {
    source[w] = source[passed];
  }
  this->Queue.put(w, distance);
}

FrontRoot March::rootOf(std::uint32_t vertex) const
{
  if (!this->Window.hasRoots())
  {
    return {};
  }
  const double* const point = this->Window.point(vertex);
  const bool isPoint =
    this->Window.distance()[vertex] == 0 && (this->Window.flags()[vertex] & OfRegion) == 0;
  return isPoint ? FrontRoot{ { point[0], point[1], point[2] }, 0 } : this->Window.root(vertex);
}

template <std::size_t N>
FrontRoot March::commonRoot(const std::array<std::uint32_t, N>& corners) const
{
  const FrontRoot root = this->rootOf(corners[0]);
  const bool isOne = std::all_of(corners.begin() + 1, corners.end(),
    [&](std::uint32_t corner) { return this->rootOf(corner) == root; });
  return isOne ? root : FrontRoot();
}

template <std::size_t N>
void March::limit(
  std::uint32_t w, Arrival& arrival, const std::array<std::uint32_t, N>& corners) const
{
  const FrontRoot root = this->commonRoot(corners);
  if (root.isKnown())
  {
    arrival.distance = std::max(arrival.distance, root.at(this->Window.point(w)));
  }
}

template <std::size_t N>
FrontRoot March::rootThrough(
  std::uint32_t w, double distance, const std::array<std::uint32_t, N>& corners) const
{
  const FrontRoot root = this->commonRoot(corners);
  // Through an edge, most paths turn.
  if (root.isKnown() && root.at(this->Window.point(w)) >= distance * (1 - Straightness))
  {
    return root;
  }
  const double* const point = this->Window.point(corners[0]);
  return N > 1 ? FrontRoot()
               : FrontRoot{ { point[0], point[1], point[2] }, this->Window.distance()[corners[0]] };
}

bool March::gains(std::uint32_t w, double distance, const FrontRoot& root) const
{
  return root.offset == 0 ||
         distance + LeastGain * (distance - root.offset) < this->Window.distance()[w];
}

void March::offerLine(std::uint32_t v, std::uint32_t w)
{
  const FrontRoot root = this->rootOf(v);
  // The front of a region is straight.
  if (!root.isKnown() || this->isOfRegion(v))
  {
    return;
  }
  const Arrival line{ root.at(this->Window.point(w)) };
  std::array<std::uint32_t, 3> via;
  if (!this->isNews(w, line))
  {
    // A path of this length from there is the line.
    const double distance = this->Window.distance()[w];
    if (line.distance <= distance * (1 + Straightness) && !(this->Window.root(w) == root) &&
        line.distance >= distance * (1 - Straightness) && this->haveOneSource(v, w))
    {
      this->Window.setRoot(w, root);
      this->Window.flags()[w] |= Changed;
    }
  }
  else if (this->gains(w, line.distance, root) && this->Sight.sees(w, root, via))
  {
    this->Window.arrive(w, root.point, v);
    this->Window.setRoot(w, root);
    this->accept(w, line, v, via);
  }
}

void March::offerNearest(std::uint32_t w, const std::array<std::uint32_t, 3>& face)
{
  const NearestSource& nearest = this->Window.nearest(w);
  if (this->Sight.hasNearest(w) || !this->Sight.seesNearest(w, face))
  {
    return;
  }
  // The corner whose own nearest point is closest to this one has its kind of front.
  const auto away = [&](std::uint32_t v)
  {
    const Vector way = difference(this->Window.nearest(v).point.data(), nearest.point.data());
    return dot(way, way);
  };
  const std::uint32_t passed = *std::ranges::min_element(face, {}, away);
  const Arrival line{ nearest.distance, (this->Window.flags()[passed] & Straight) != 0 };
  if (this->isNews(w, line))
  {
    this->Window.arrive(w, nearest.point, passed);
    this->Window.setRoot(w, this->isOfRegion(passed) ? FrontRoot() : FrontRoot{ nearest.point, 0 });
    this->accept(w, line, passed, face);
    if (std::int64_t* const source = this->Window.source())
    {
      source[w] = nearest.source;
    }
  }
}

/** The path crosses the facet of these corners, an edge or a face, or comes from a single one. */
template <std::size_t N>
void March::arrive(
  std::uint32_t w, const Arrival& arrival, const std::array<std::uint32_t, N>& corners)
{
  const double* first = this->Window.point(corners[0]);
  Vector crossing{ first[0], first[1], first[2] };
  for (std::size_t n = 1; n < N; ++n)
  {
    const Vector edge = difference(this->Window.point(corners[n]), first);
    for (std::size_t k = 0; k < 3; ++k)
    {
      crossing[k] += arrival.weight[n - 1] * edge[k];
    }
  }
  this->Window.arrive(w, crossing, corners[static_cast<std::size_t>(arrival.nearestCorner())]);
  if (this->Window.hasRoots())
  {
    this->Window.setRoot(w,
      this->isOfRegion(corners[0]) ? FrontRoot() : this->rootThrough(w, arrival.distance, corners));
  }
}

template <int Corners>
bool March::isBesideCurve(std::uint32_t v, std::uint32_t w) const
{
  const double* point = this->Window.point(v);
  // The curve at v consists of the edges from v to other sources in its cells. If w lies ahead of
  // one of them, or perpendicular to it, a point of that edge is at least as near to w as v is.
  const Vector way = difference(this->Window.point(w), point);
  bool isBeside = false;
  this->Window.forCellsOf<Corners>(v,
    [&](const std::uint32_t* cell)
    {
      for (int c = 0; c < Corners && !isBeside; ++c)
      {
        const Vector edge = difference(this->Window.point(cell[c]), point);
        const double margin = Perpendicular * std::sqrt(dot(way, way) * dot(edge, edge));
        isBeside =
          cell[c] != v && this->Window.distance()[cell[c]] == 0 && dot(way, edge) > -margin;
      }
    });
  return isBeside;
}

template <int Corners>
void March::offerEdge(std::uint32_t v, std::uint32_t w, double length)
{
  const FrontCorner from = this->corner(v);
  Arrival arrival = fromCorner(from, length);
  if (from.isStraight && from.distance == 0)
  {
    // Straight beside the curve, round beyond its end: see the class.
    arrival.isStraight = this->isBesideCurve<Corners>(v, w);
  }
  this->offer(w, arrival, std::array{ v });
}

/** Offers paths from v, and across its edges, to the other two corners of a triangle. */
void March::passOn(std::uint32_t v, const std::array<std::uint32_t, 3>& others)
{
  // Squares and products of the edges at v are computed once for both corners.
  const FrontCorner from = this->corner(v);
  const Vector e[2] = { difference(this->Window.point(others[0]), from.point),
    difference(this->Window.point(others[1]), from.point) };
  const double square[2] = { dot(e[0], e[0]), dot(e[1], e[1]) };
  const double product = dot(e[0], e[1]);
  for (int k = 0; k < 2; ++k)
  {
    // The edge from v to b is the one that the path to w may cross; the frame has v as its origin.
    const std::uint32_t w = others[k], b = others[1 - k];
    const FrontCorner passed = this->corner(b);
    // The front has passed w before both others: it comes from there, and has nothing to gain.
    if (this->Window.distance()[w] <= std::min(from.distance, passed.distance))
    {
      continue;
    }
    if (passed.distance < Infinite && this->haveOneSource(v, b))
    {
      const Arrival across = acrossEdge({ square[1 - k], product, square[k] }, from, passed);
      // A path across the edge is at most as long as the paths along the edges from v and b to w,
      // so these need not be offered, unless it does not count.
      if (across.distance < Infinite && this->offer(w, across, std::array{ v, b }))
      {
        continue;
      }
    }
    this->offerEdge<3>(v, w, std::sqrt(square[k]));
  }
}

/** Offers paths from v, along its edges and across its facets, to the other three corners of a
 * tetrahedron: through the face opposite to w if the path crosses its inside, else through one of
 * its two edges at v, else along the edge from v. Paths through the edge opposite to v are offered
 * when its ends are taken. */
void March::passOn(std::uint32_t v, const std::array<std::uint32_t, 4>& others)
{
  const FrontCorner from = this->corner(v);
  Vector e[3];
  // All scalar products of the edges at v: each face and edge needs some of them, in a frame whose
  // origin is v.
  double product[3][3];
  for (int i = 0; i < 3; ++i)
  {
    e[i] = difference(this->Window.point(others[i]), from.point);
    for (int j = 0; j <= i; ++j)
    {
      product[i][j] = product[j][i] = dot(e[i], e[j]);
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const std::uint32_t w = others[k];
    // The face opposite to w has the corners v, i and j.
    const FrontCorner b = this->corner(others[i]), c = this->corner(others[j]);
    const double before = this->Window.distance()[w];
    if (before <= std::min({ from.distance, b.distance, c.distance }))
    {
      continue;
    }
    if (std::max(b.distance, c.distance) < Infinite && this->haveOneSource(v, others[i]) &&
        this->haveOneSource(v, others[j]))
    {
      Arrival across = acrossFace({ product[i][i], product[i][j], product[j][j], product[k][i],
                                    product[k][j], product[k][k] },
        from, b, c);
      this->limit(w, across, std::array{ v, others[i], others[j] });
      if (across.distance < Infinite &&
          this->offer(w, across, std::array{ v, others[i], others[j] }))
      {
        continue;
      }
    }
    // Both edges are tried, since the path may lie on either side of the face's inside.
    bool crosses = false;
    for (const int n : { i, j })
    {
      const FrontCorner& passed = n == i ? b : c;
      if (passed.distance < Infinite && this->haveOneSource(v, others[n]))
      {
        Arrival across = acrossEdge({ product[n][n], product[k][n], product[k][k] }, from, passed);
        this->limit(w, across, std::array{ v, others[n] });
        crosses =
          (across.distance < Infinite && this->offer(w, across, std::array{ v, others[n] })) ||
          crosses;
      }
    }
    if (!crosses)
    {
      this->offerEdge<4>(v, w, std::sqrt(product[k][k]));
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->offerLine(v, others[k]);
    if (this->Window.hasNearest() && this->Sight.hasNearest(v))
    {
      this->offerNearest(others[k], { v, others[(k + 1) % 3], others[(k + 2) % 3] });
    }
  }
}

} // namespace smg
