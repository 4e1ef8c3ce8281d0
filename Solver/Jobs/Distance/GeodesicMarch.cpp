// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/GeodesicMarch.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

// Exact distances on a surface of triangles (Mitchell, Mount and Papadimitriou, The discrete
// geodesic problem, 1987), in the order of the distance, in a window of the stream. A shortest path
// is straight through unfolded triangles, and turns at vertices with an angle of more than 2 pi
// around them, or pi on the boundary, alone. So the front is a set of intervals of edges
// (FrontInterval.h), each of which sees one source or such a vertex. An interval passes on what the
// third corner of the next triangle leaves of it to one or both of the other edges; what an edge
// has is disjoint (EdgeFronts); a vertex that paths may turn at sends intervals to the edges
// opposite to it.
//
// Most intervals are left out since a path by way of a corner is shorter, before they are compared
// with others (Xin and Wang, Improving Chen and Han's algorithm, 2009).
//
// Invariants. Every distance is that of a path, so that what is left out is not part of a shortest
// one, whatever the order is: a window, and its passes, cost work, but no accuracy. The order
// depends on neither the memory limit nor the blocks of the stream, so that the result has the same
// bits.

namespace smg
{

namespace
{

/** Numbers of vertices in the queue have this bit, those of intervals have not. */
constexpr std::uint32_t VertexBit = 0x80000000;
/** How far from the end of an interval, relative to the edge, its paths count as those of a corner.
 */
constexpr double Margin = 1e-9;
/** Angles around a vertex above a full turn by more than this let paths turn there. */
constexpr double Excess = 1e-9;
/** How far from the end of an interval, relative to the distance from its image, its paths still
 * see a corner: more than what the gap behind a vertex of a smaller excess hides. Distances are
 * wrong by the square of that. */
constexpr double Reach = 1e-6;
/** Whether a path is longer than that by way of a corner. One that only rounding makes longer, as
 * along an edge, may lead on to where no path by way of the corner does. */
bool isLonger(double path, double byCorner)
{
  constexpr double Rounding = 1e-10;
  return path > (1 + Rounding) * byCorner;
}

/** What vertices keep of the front that has reached them, for the directions. */
constexpr std::uint8_t FrontFlags = Straight | OfRegion;

} // namespace

GeodesicMarch::GeodesicMarch(ChunkedMesh& mesh, Pool& pool)
  : ChunkMarch(mesh, pool)
  , Fronts(pool, 3 * this->Window.cellNumbers())
  , Queue(pool)
{
  if (3 * this->Window.cellNumbers() >= std::int64_t(FrontInterval::None))
  {
    throw Error("the stream is too wide for exact distances: choose approximate ones (accuracy)");
  }
}

std::int64_t GeodesicMarch::bytes(
  const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells, std::int64_t crossingCells)
{
  return MarchWindow::bytes(plan, vertices, innerCells, crossingCells) +
         ChunkPlan::WindowChunks * 3 * (innerCells + crossingCells) *
           std::int64_t(sizeof(std::uint32_t)) +
         LeastFrontBytes + FrontBytes * std::min(plan.window(), vertices);
}

double GeodesicMarch::lengthOf(std::uint32_t a, std::uint32_t b) const
{
  const Vector edge = difference(this->Window.point(b), this->Window.point(a));
  return std::sqrt(dot(edge, edge));
}

void GeodesicMarch::settle(std::int64_t first, std::int64_t last)
{
  constexpr std::size_t Often = 1 << 12;
  this->begin(first, last);
  for (std::size_t taken = 0; !this->Queue.isEmpty(); ++taken)
  {
    if (taken % Often == 0)
    {
      this->poll();
    }
    const FrontQueue::Entry next = this->Queue.take();
    if ((next.number & VertexBit) != 0)
    {
      this->leave(next.number & ~VertexBit);
    }
    else if (this->Fronts.isWaiting(next.number))
    {
      this->passOn(next.number);
    }
    if (this->Fronts.isFull())
    {
      const double front = FrontQueue::distanceOf(next.key);
      this->Fronts.forget(
        [this, front](const FrontInterval& interval)
        {
          const double* const distance = this->Window.distance();
          return distance[interval.first] + distance[interval.second] +
                   this->lengthOf(interval.first, interval.second) <
                 2 * front;
        });
    }
  }
  this->Fronts.clear();
}

/** Takes up what the chunks have left. */
void GeodesicMarch::begin(std::int64_t first, std::int64_t last)
{
  const std::uint8_t* const flags = this->Window.flags();
  const double* const distances = this->Window.distance();
  for (std::int64_t chunk = first; chunk <= last; ++chunk)
  {
    const std::uint32_t from = this->Window.placeOf(chunk);
    const auto to = from + static_cast<std::uint32_t>(this->Window.mesh().countOf(chunk));
    for (std::uint32_t v = from; v < to; ++v)
    {
      if ((flags[v] & Dirty) != 0)
      {
        this->Queue.put(v | VertexBit, distances[v]);
      }
    }
    std::vector<FrontInterval> waiting;
    std::swap(waiting, this->Window.waiting(chunk));
    for (const FrontInterval& interval : waiting)
    {
      this->Window.flags()[interval.first] |= Changed;
      this->add(interval, this->lengthOf(interval.first, interval.second));
    }
  }
}

Vector GeodesicMarch::pointOf(std::uint32_t first, std::uint32_t second, double share) const
{
  const double* from = this->Window.point(first);
  const Vector edge = difference(this->Window.point(second), from);
  return { from[0] + share * edge[0], from[1] + share * edge[1], from[2] + share * edge[2] };
}

void GeodesicMarch::offer(std::uint32_t v, double distance, std::int64_t source, std::uint8_t front,
  const Vector& crossing, std::uint32_t via, const PathArrival& arrival)
{
  double& known = this->Window.distance()[v];
  // Beside a source, rounding may make it negative.
  distance = std::max(distance, 0.0);
  if (distance > this->Window.mesh().plan.within)
  {
    return;
  }
  if (distance < known - this->Same * known || known == HUGE_VAL)
  {
    known = distance;
    std::uint8_t& flags = this->Window.flags()[v];
    flags = static_cast<std::uint8_t>((flags & ~FrontFlags) | Dirty | Changed | front);
    if (std::int64_t* const sources = this->Window.source())
    {
      sources[v] = source;
    }
    this->Window.arrive(v, crossing, via);
    this->Window.arrive(v, arrival);
    this->Queue.put(v | VertexBit, distance);
  }
  else if ((front & Straight) != 0 && distance <= known + this->Same * known && known > 0)
  {
    // Of two fronts that arrive at the same time, the straight one counts.
    this->Window.flags()[v] |= front | Changed;
  }
}

void GeodesicMarch::leave(std::uint32_t v)
{
  std::uint8_t& flags = this->Window.flags()[v];
  if ((flags & Dirty) == 0)
  {
    return;
  }
  const bool hasAll = this->Window.hasAllCellsOf(v);
  const bool turns = hasAll && this->mayTurnAt(v);
  flags |= Changed;
  if (hasAll)
  {
    flags &= static_cast<std::uint8_t>(~Dirty);
  }
  if (++this->Left > MostLeft * this->Window.mesh().vertices)
  {
    this->Same *= 10;
    this->Left = 0;
  }
  const double distance = this->Window.distance()[v];
  this->Window.forCellsOf<3>(v,
    [&](const std::uint32_t* cell)
    {
      const int k = cell[0] == v ? 0 : cell[1] == v ? 1 : 2;
      const std::uint32_t p = cell[(k + 1) % 3], q = cell[(k + 2) % 3];
      for (const std::uint32_t w : { p, q })
      {
        this->offer(w, distance + this->lengthOf(v, w), this->sourceOf(v), flags & OfRegion,
          this->pointOf(v, v, 0.0), v, { v, v, {} });
        const bool isCurve = (flags & this->Window.flags()[w] & Straight) != 0 && distance == 0 &&
                             this->Window.distance()[w] == 0;
        if (isCurve && hasAll)
        {
          this->leaveCurve(v, w);
        }
      }
      if (turns)
      {
        this->leaveThrough(v, p, q);
      }
    });
}

bool GeodesicMarch::mayTurnAt(std::uint32_t v)
{
  std::uint8_t& flags = this->Window.flags()[v];
  if (this->Window.distance()[v] == 0)
  {
    return true;
  }
  if ((flags & (Passed | Turning)) == 0)
  {
    auto& around = this->Around;
    around.clear();
    double angle = 0;
    bool isFlat = false;
    this->Window.forCellsOf<3>(v,
      [&](const std::uint32_t* cell)
      {
        const int k = cell[0] == v ? 0 : cell[1] == v ? 1 : 2;
        const std::uint32_t p = cell[(k + 1) % 3], q = cell[(k + 2) % 3];
        around.insert(around.end(), { { p, q }, { q, p } });
        const Vector e = difference(this->Window.point(p), this->Window.point(v));
        const Vector f = difference(this->Window.point(q), this->Window.point(v));
        const Vector normal = smg::cross(e, f);
        const double area = std::sqrt(dot(normal, normal));
        isFlat = isFlat || !(area > 0);
        angle += std::atan2(area, dot(e, f));
      });
    const double straight = this->straightAngle();
    const bool turns = isFlat || angle > straight + Excess;
    flags |= turns ? Turning : Passed;
  }
  return (flags & Turning) != 0;
}

/** The angle around a vertex above which paths may turn there: of a closed ring of triangles a full
 * turn, of an open fan, at the boundary, half a turn, of anything else none. Each neighbour is in
 * two triangles, but the two ends of a fan, and one walk from neighbour to neighbour comes to all.
 */
double GeodesicMarch::straightAngle()
{
  auto& around = this->Around;
  std::ranges::sort(around);
  const std::size_t triangles = around.size() / 2;
  std::uint32_t first = around.empty() ? 0 : around[0].first;
  int ends = 0;
  for (std::size_t i = 0; i < around.size();)
  {
    std::size_t next = i + 1;
    while (next < around.size() && around[next].first == around[i].first)
    {
      ++next;
    }
    if (next - i > 2)
    {
      return 0.0;
    }
    first = next - i == 1 ? around[i].first : first;
    ends += next - i == 1 ? 1 : 0;
    i = next;
  }
  std::uint32_t before = FrontInterval::None, at = first;
  std::size_t steps = 0;
  while (steps < triangles && (steps == 0 || at != first))
  {
    auto place = std::ranges::lower_bound(
      around, at, {}, [](const auto& neighbours) { return neighbours.first; });
    place += place->second == before ? 1 : 0;
    if (place == around.end() || place->first != at)
    {
      break; // the other end
    }
    before = std::exchange(at, place->second);
    ++steps;
  }
  return steps < triangles ? 0.0 : ends == 0 ? 2 * std::numbers::pi : std::numbers::pi;
}

void GeodesicMarch::leaveThrough(std::uint32_t v, std::uint32_t p, std::uint32_t q)
{
  const std::uint32_t a = std::min(p, q), b = std::max(p, q);
  const Vector edge = difference(this->Window.point(b), this->Window.point(a));
  const Vector to = difference(this->Window.point(v), this->Window.point(a));
  const double length = std::sqrt(dot(edge, edge));
  if (length > 0)
  {
    const FramePoint at = inFrame(to, edge, length);
    const FrontImage image{ at.x, at.y, this->Window.distance()[v], false };
    this->add({ 0, length, image, this->sourceOf(v), a, b, v, this->isOfRegion(v) }, length);
  }
}

/** The edge between two sources is a source: each half of it that of the nearer end. */
void GeodesicMarch::leaveCurve(std::uint32_t v, std::uint32_t w)
{
  const std::uint32_t a = std::min(v, w), b = std::max(v, w);
  const double length = this->lengthOf(a, b);
  const FrontImage image{ 0, 1, 0, true };
  this->add({ 0, 0.5 * length, image, this->sourceOf(a), a, b, FrontInterval::None, true }, length);
  this->add(
    { 0.5 * length, length, image, this->sourceOf(b), a, b, FrontInterval::None, true }, length);
}

void GeodesicMarch::add(FrontInterval interval, double length)
{
  const double* const distances = this->Window.distance();
  const double atFirst = distances[interval.first], atSecond = distances[interval.second];
  const FrontImage& image = interval.image;
  // Paths by way of the corners of the edge are shorter.
  const double least = image.least(interval.begin, interval.end);
  if (least > this->Window.mesh().plan.within)
  {
    return;
  }
  if (interval.from != FrontInterval::None &&
      (isLonger(image.at(interval.end), atFirst + interval.end) ||
        isLonger(image.at(interval.begin), atSecond + (length - interval.begin)) ||
        isLonger(2 * least, atFirst + atSecond + length)))
  {
    return;
  }
  std::uint32_t edge = FrontInterval::None;
  // Of a vertex of few cells, where the other one is the hub of many.
  const bool isFirst =
    this->Window.cellsOf(interval.first) <= this->Window.cellsOf(interval.second);
  const std::uint32_t one = isFirst ? interval.first : interval.second;
  const std::uint32_t two = isFirst ? interval.second : interval.first;
  this->Window.forCellsOf<3>(one,
    [&](const std::uint32_t* cell, std::uint32_t number)
    {
      for (std::uint32_t k = 0; k < 3 && edge == FrontInterval::None; ++k)
      {
        if (cell[k] == two)
        {
          // The edge between them is opposite to the third corner.
          const std::uint32_t other = cell[(k + 1) % 3] == one ? (k + 2) % 3 : (k + 1) % 3;
          edge = 3 * number + other;
        }
      }
    });
  if (edge == FrontInterval::None)
  {
    this->wait(interval);
    return;
  }
  for (const std::uint32_t number : this->Fronts.insert(edge, interval))
  {
    const FrontInterval& part = this->Fronts.at(number);
    this->Queue.put(number, part.image.least(part.begin, part.end));
  }
}

/** Leaves an interval to a position of the window that has all triangles of its edge. */
void GeodesicMarch::wait(const FrontInterval& interval)
{
  const std::int64_t chunk =
    std::max(this->Window.chunkOf(interval.first), this->Window.chunkOf(interval.second));
  this->Window.waiting(chunk).push_back(interval);
  for (const std::uint32_t v : { interval.first, interval.second })
  {
    this->Window.flags()[v] |= Changed;
  }
}

void GeodesicMarch::passOn(std::uint32_t number)
{
  const FrontInterval interval = this->Fronts.at(number);
  this->Fronts.take(number);
  const std::uint32_t a = interval.first, b = interval.second;
  if (!this->Window.hasAllCellsOf(a) && !this->Window.hasAllCellsOf(b))
  {
    this->wait(interval);
    return;
  }
  const double* const origin = this->Window.point(a);
  const Vector edge = difference(this->Window.point(b), origin);
  const double length = std::sqrt(dot(edge, edge));
  this->Window.forCornersBeside(a, b,
    [&](std::uint32_t corner)
    {
      if (corner != interval.from)
      {
        const FramePoint at = inFrame(difference(this->Window.point(corner), origin), edge, length);
        this->enter(interval, length, { corner, at.x, at.y });
      }
    });
}

void GeodesicMarch::enter(const FrontInterval& interval, double length, const Triangle& triangle)
{
  const FrontImage& image = interval.image;
  const double x = triangle.x, y = triangle.y, margin = Margin * length;
  // The middle corner of a cell without area lies on the edge opposite to it: all paths from there
  // cross the edge at one point, in every direction.
  const bool isOnEdge = !image.isStraight && image.depth <= margin &&
                        image.x >= interval.begin - margin && image.x <= interval.end + margin;
  if (!isOnEdge && !(image.depth > 0))
  {
    return; // along the edge
  }
  const double crossing = image.crossing(x, y);
  const bool isLeft = isOnEdge || crossing > interval.begin + margin,
             isRight = isOnEdge || crossing < interval.end - margin;
  const double reach = margin + Reach * (image.at(x, y) - (image.isStraight ? 0.0 : image.offset));
  if (crossing >= interval.begin - reach && crossing <= interval.end + reach)
  {
    const int front = (image.isStraight ? Straight : 0) | (interval.isOfRegion ? OfRegion : 0);
    const double share = std::clamp(crossing, interval.begin, interval.end) / length;
    this->offer(triangle.corner, image.at(x, y), interval.source, static_cast<std::uint8_t>(front),
      this->pointOf(interval.first, interval.second, share),
      share < 0.5 ? interval.first : interval.second, { interval.first, interval.second, image });
  }
  const double known = this->Window.distance()[triangle.corner];
  const std::uint32_t a = interval.first, b = interval.second, c = triangle.corner;
  // Paths to the one side of the third corner, unless those by way of it are shorter.
  if (isLeft && !isLonger(image.at(interval.begin), known + norm(x - interval.begin, y)))
  {
    const double all = norm(x, y);
    const double begin = isOnEdge ? 0 : image.shareBeyond(x, y, interval.begin);
    const double end =
      isRight || crossing <= interval.end + margin ? 1 : image.shareBeyond(x, y, interval.end);
    this->cross({ begin * all, end * all, image.beyond(x, y, all), interval.source, a, c, b,
                  interval.isOfRegion },
      all);
  }
  if (isRight && !isLonger(image.at(interval.end), known + norm(x - interval.end, y)))
  {
    const FrontImage mirrored = image.reversed(length);
    const double mx = length - x, all = norm(mx, y);
    const double begin = isOnEdge ? 0 : mirrored.shareBeyond(mx, y, length - interval.end);
    const double end = isLeft || crossing >= interval.begin - margin
                         ? 1
                         : mirrored.shareBeyond(mx, y, length - interval.begin);
    this->cross({ begin * all, end * all, mirrored.beyond(mx, y, all), interval.source, b, c, a,
                  interval.isOfRegion },
      all);
  }
}

/** Adds an interval whose corners may be in the other order. */
void GeodesicMarch::cross(FrontInterval interval, double length)
{
  if (interval.second < interval.first)
  {
    std::swap(interval.first, interval.second);
    interval.image = interval.image.reversed(length);
    interval.begin = std::exchange(interval.end, length - interval.begin);
    interval.begin = length - interval.begin;
  }
  if (length > 0 && interval.end > interval.begin)
  {
    this->add(interval, length);
  }
}

} // namespace smg
