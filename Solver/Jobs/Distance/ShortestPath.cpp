// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/ShortestPath.h"

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/SourceLabel.h"

#include <algorithm>
#include <cmath>

// A shortest path on a surface of triangles is straight between the vertices at which it turns. So
// from a vertex it runs towards one image of the next of these (FrontInterval.h), which the march
// has stored. It is followed from edge to edge, with the image unfolded into the plane of each next
// triangle, until the way by a corner is as short as going on: the path passes there, and goes on
// with the image of that corner, so that rounding does not add up.
//
// At an edge of several triangles each is tried. A wrong one is left as soon as a vertex is farther
// from the sources than the rest of the path would allow, and what it leads to counts only if it is
// a source: the length of a path is the distance, or there is no path.
//
// Cost: the triangles that are crossed, and reading their chunks of the stream.

namespace smg
{

namespace
{

/** A way by a corner is as short as the path if it is longer by at most this share of what is left.
 */
constexpr double AsShort = 1e-10;
/** What rounding makes of a way of no length, relative to the whole path, and to coordinates. */
constexpr double NoLength = 1e-12, Digits = 1e-15;
/** A vertex is too far away for the path if it is by this share of the whole path. */
constexpr double TooFar = 1e-6;
/** The length of a path is the distance up to this share of it. */
constexpr double AsLong = 1e-8;
/** How many triangles may be tried for one straight part, relative to those of the mesh. */
constexpr std::int64_t MostTries = 16;

double lengthBetween(const double* a, const double* b)
{
  const Vector edge = difference(a, b);
  return std::sqrt(dot(edge, edge));
}

} // namespace

Report::Path ShortestPath::to(std::int64_t vertex)
{
  const ChunkPlan& plan = this->Window.mesh().plan;
  this->Middle = -1;
  this->Window.show(vertex / plan.length, vertex / plan.length);
  this->Path = {};
  std::uint32_t v = plan.local(vertex);
  const double* const end = this->Window.point(v);
  const double whole = this->Window.distance()[v];
  this->Rounding = Digits * (std::fabs(end[0]) + std::fabs(end[1]) + std::fabs(end[2]) + whole);
  if (std::isinf(whole))
  {
    this->Path.length = whole;
    return this->Path;
  }
  const auto pass = [this](std::uint32_t at)
  {
    const double* const point = this->Window.point(at);
    this->add({ point[0], point[1], point[2] });
    this->Path.from = numberOfLabel(this->Window.source()[at]);
  };
  pass(v);
  while (v != None && this->Window.distance()[v] > 0)
  {
    this->Reported.poll();
    this->showAround(v, v);
    const PathArrival& arrival = this->Window.arrival(v);
    v = arrival.first == arrival.second ? arrival.first : this->passStraight(v);
    if (v != None)
    {
      pass(v);
    }
  }
  if (this->Path.from < 0 ||
      !(std::fabs(this->Path.length - whole) <= AsLong * whole + this->Rounding))
  {
    this->Path.from = -1;
    this->Path.points.clear();
    this->Path.length = whole;
  }
  std::ranges::reverse(this->Path.points);
  return this->Path;
}

std::uint32_t ShortestPath::passStraight(std::uint32_t vertex)
{
  this->Whole = this->Window.distance()[vertex];
  this->Left = MostTries * this->Window.mesh().cells();
  this->HasForked = false;
  this->Before = this->Path.length;
  this->Path.from = -1;
  return this->follow(this->firstCrossing(vertex)).value_or(None);
}

std::optional<std::uint32_t> ShortestPath::follow(Crossing crossing)
{
  while (this->Left-- > 0 && crossing.isAhead())
  {
    const double* const origin = this->Window.point(crossing.a);
    const Vector edge = difference(this->Window.point(crossing.b), origin);
    const double share = crossing.at / crossing.length, left = crossing.left();
    this->add(
      { origin[0] + share * edge[0], origin[1] + share * edge[1], origin[2] + share * edge[2] });
    if (left < -AsShort * this->Whole || !this->isStraight(left))
    {
      return {}; // past the image, or beside the edge
    }
    if (left <= AsShort * this->Whole && this->isSource(crossing))
    {
      this->Path.from = numberOfLabel(this->Window.source()[share < 0.5 ? crossing.a : crossing.b]);
      return None;
    }
    this->showAround(crossing.a, crossing.b);
    const std::vector<std::uint32_t> corners = this->cornersBeyond(crossing);
    std::vector<std::uint32_t> ends = corners;
    ends.insert(ends.end(), { crossing.a, crossing.b });
    for (const std::uint32_t v : ends)
    {
      if (this->Window.distance()[v] < this->Whole && this->isBy(v, left))
      {
        return v;
      }
    }
    if (this->HasForked && std::ranges::any_of(ends,
                             [this, left](std::uint32_t v) { return this->isTooFar(v, left); }))
    {
      return {};
    }
    if (corners.size() != 1)
    {
      return this->followOneOf(crossing, corners);
    }
    crossing = this->next(crossing, corners[0]);
  }
  return {};
}

std::optional<std::uint32_t> ShortestPath::followOneOf(
  const Crossing& crossing, const std::vector<std::uint32_t>& corners)
{
  this->HasForked = true;
  const std::size_t points = this->Path.points.size();
  const double length = this->Path.length;
  for (const std::uint32_t corner : corners)
  {
    this->showAround(crossing.a, crossing.b);
    if (const auto end = this->follow(this->next(crossing, corner)))
    {
      return end;
    }
    this->Path.points.resize(points);
    this->Path.length = length;
  }
  return {};
}

ShortestPath::Crossing ShortestPath::firstCrossing(std::uint32_t vertex) const
{
  const PathArrival& arrival = this->Window.arrival(vertex);
  Crossing first{ arrival.first, arrival.second, vertex, arrival.image };
  const double* const origin = this->Window.point(first.a);
  const Vector edge = difference(this->Window.point(first.b), origin);
  const Vector to = difference(this->Window.point(vertex), origin);
  first.length = std::sqrt(dot(edge, edge));
  const FramePoint at = inFrame(to, edge, first.length);
  first.at = std::clamp(first.image.crossing(at.x, at.y), 0.0, first.length);
  return first;
}

std::vector<std::uint32_t> ShortestPath::cornersBeyond(const Crossing& crossing) const
{
  std::vector<std::uint32_t> corners;
  this->Window.forCornersBeside(crossing.a, crossing.b,
    [&](std::uint32_t corner)
    {
      if (corner != crossing.passed)
      {
        corners.push_back(corner);
      }
    });
  return corners;
}

ShortestPath::Crossing ShortestPath::next(Crossing crossing, std::uint32_t corner) const
{
  // Of the corner below the edge: where it is along the edge, and how deep.
  const Vector edge = difference(this->Window.point(crossing.b), this->Window.point(crossing.a));
  const Vector to = difference(this->Window.point(corner), this->Window.point(crossing.a));
  auto [x, y] = inFrame(to, edge, crossing.length);
  const FrontImage& image = crossing.image;
  // Where the path is at the depth of the corner.
  const double across = image.isStraight  ? crossing.at - y * image.x / image.depth
                        : image.depth > 0 ? crossing.at + y * (image.x - crossing.at) / image.depth
                                          : image.x;
  if (across > x)
  {
    std::swap(crossing.a, crossing.b);
    crossing.image = image.reversed(crossing.length);
    crossing.at = crossing.length - crossing.at;
    x = crossing.length - x;
  }
  // Not from x and y, whose errors would grow from triangle to triangle.
  const double length = lengthBetween(this->Window.point(crossing.a), this->Window.point(corner));
  Crossing beyond{ crossing.a, corner, crossing.b, crossing.image.beyond(x, -y, length) };
  beyond.length = length;
  beyond.at = std::clamp(
    beyond.image.crossing(crossing.at * x / length, crossing.at * y / length), 0.0, length);
  return beyond;
}

void ShortestPath::showAround(std::uint32_t a, std::uint32_t b)
{
  // A cell extends from its own chunk to the one before.
  const std::int64_t chunk = std::max(this->Window.chunkOf(a), this->Window.chunkOf(b));
  if (chunk != this->Middle)
  {
    this->Reported.poll();
    this->Window.show(
      std::max<std::int64_t>(chunk - 1, 0), std::min(chunk + 1, this->Window.mesh().count() - 1));
    this->Middle = chunk;
  }
}

bool ShortestPath::isStraight(double left) const
{
  return std::fabs(this->Path.length - this->Before + left - this->Whole) <=
         AsLong * this->Whole + this->Rounding;
}

bool ShortestPath::isSource(const Crossing& crossing) const
{
  const std::uint8_t* const flags = this->Window.flags();
  const double* const distance = this->Window.distance();
  return crossing.image.isStraight && (flags[crossing.a] & flags[crossing.b] & Straight) != 0 &&
         distance[crossing.a] == 0 && distance[crossing.b] == 0;
}

bool ShortestPath::isBy(std::uint32_t vertex, double left) const
{
  return this->Window.distance()[vertex] + this->wayTo(vertex) <=
         (1 + AsShort) * left + NoLength * this->Whole + this->Rounding;
}

bool ShortestPath::isTooFar(std::uint32_t vertex, double left) const
{
  const double distance = this->Window.distance()[vertex];
  return std::isfinite(distance) && distance - this->wayTo(vertex) > left + TooFar * this->Whole;
}

double ShortestPath::wayTo(std::uint32_t vertex) const
{
  return lengthBetween(this->Path.points.back().data(), this->Window.point(vertex));
}

void ShortestPath::add(const Vector& point)
{
  auto& points = this->Path.points;
  if (points.empty() || points.back() != point)
  {
    this->Path.length += points.empty() ? 0.0 : lengthBetween(points.back().data(), point.data());
    points.push_back(point);
  }
}

} // namespace smg
