// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/PolygonTriangulation.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// Triangulation of a polygon by ears (Meisters, Polygons have ears, 1975), the best-shaped first.
//
// A corner with its two neighbours is an ear if it is convex and no other corner that is not convex
// lies in the triangle. Cutting it off leaves a polygon of the same kind, of one corner fewer; a
// simple polygon always has two ears. Of those, the one of the best shape is taken, so that corners
// on a straight side do not become triangles without area.
//
// Of a polygon whose sides cross there may be no ear: then the best-shaped convex corner is cut
// off, and overlaps() tells that the areas of the triangles do not add up to that of the polygon.
//
// Cost: ears are in a heap, and corners in strips (PointStrips.h), so that an ear is compared only
// with corners near it: about O(n log n) where ears are small, O(n^1.5) where they are long, O(n^2)
// at worst, as where all corners are at a few places.

namespace smg
{

namespace
{

constexpr std::uint32_t Gone = std::numeric_limits<std::uint32_t>::max();

/** A triangle of less area, relative to its longest side, is flat: the corners lie on a line, up to
 * the tolerance of a drawing. The second one is the rounding of single precision. */
constexpr double FlatQuality = 1e-4, LineQuality = 1e-7;
/** Areas beyond this one, or their squares, may be no numbers. */
constexpr double Most = 1e150;
constexpr double Any = -std::numeric_limits<double>::infinity();

double turn(const std::array<double, 2>& a, const std::array<double, 2>& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

double squareOf(const std::array<double, 2>& a, const std::array<double, 2>& b)
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

} // namespace

void PolygonTriangulation::cut(std::span<const double> corners, const std::function<void()>& poll)
{
  this->Triangles.clear();
  this->Poll = &poll;
  this->project(corners);
  this->IsFan = this->cutFan();
  if (!this->IsFan)
  {
    const double worst = this->worstQuality();
    std::vector<Triangle> fan = this->Triangles;
    this->cutEars();
    this->IsFan = worst > 0.0 && worst >= this->worstQuality();
    if (this->IsFan)
    {
      this->Triangles.swap(fan);
    }
  }
  this->Winds = this->IsFan && !this->windsOnce();
}

/** Sets the points to the corners as seen along the normal of the polygon (Newell). */
void PolygonTriangulation::project(std::span<const double> corners)
{
  const std::size_t count = corners.size() / 3;
  const auto fromFirst = [&corners](std::size_t corner)
  { return difference(&corners[3 * corner], corners.data()); };
  Vector normal{};
  Vector longest{};
  for (std::size_t k = 1; k < count; ++k)
  {
    const Vector side = fromFirst(k);
    const Vector area = k + 1 < count ? cross(side, fromFirst(k + 1)) : Vector{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      normal[axis] += area[axis];
    }
    longest = dot(side, side) > dot(longest, longest) ? side : longest;
  }
  this->Extent = dot(longest, longest);
  this->TwiceArea = std::sqrt(dot(normal, normal));
  // A polygon without area has no normal: any will do.
  const Vector n =
    this->TwiceArea > 0.0 ? scaled(1.0 / this->TwiceArea, normal) : Vector{ 0, 0, 1 };
  const auto least = static_cast<std::size_t>(
    std::ranges::min_element(n, {}, [](double c) { return std::abs(c); }) - n.begin());
  Vector axis{};
  axis[least] = 1.0;
  const Vector across = cross(axis, n);
  const Vector u = scaled(1.0 / std::sqrt(dot(across, across)), across);
  const Vector v = cross(n, u);
  this->Points.resize(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vector d = fromFirst(k);
    this->Points[k] = { dot(d, u), dot(d, v) };
  }
}

/** Of the triangles of the current cut; those with corners at one place do not count, since no cut
 * is without them. */
double PolygonTriangulation::worstQuality() const
{
  double worst = 1.0;
  for (const Triangle& t : this->Triangles)
  {
    const Point &a = this->Points[t[0]], &b = this->Points[t[1]], &c = this->Points[t[2]];
    const bool isOfThree = a != b && b != c && c != a;
    worst = isOfThree ? std::min(worst, this->qualityOf(t[0], t[1], t[2])) : worst;
  }
  return worst;
}

/** Cuts the fan of the first corner; returns whether none of its triangles is flat or turned, so
 * that it covers the polygon well. */
bool PolygonTriangulation::cutFan()
{
  const auto count = static_cast<std::uint32_t>(this->Points.size());
  for (std::uint32_t k = 1; k + 1 < count; ++k)
  {
    this->Triangles.push_back({ 0, k, k + 1 });
  }
  // Without a normal, or with squares that are no numbers, no cut is better than another.
  const bool isMeasured = this->TwiceArea > 0.0 && this->TwiceArea < Most && this->Extent < Most;
  return count == 3 || !isMeasured || this->worstQuality() > FlatQuality;
}

/** Whether the triangles of the fan, all of which turn in one sense, do so once around the first
 * corner. Two angles are always less than a turn. */
bool PolygonTriangulation::windsOnce() const
{
  double angle = 0.0;
  for (std::size_t k = 1; this->Points.size() > 4 && k + 1 < this->Points.size(); ++k)
  {
    const Point &p = this->Points[k], &q = this->Points[k + 1];
    angle += std::atan2(std::abs(turn(p, q)), p[0] * q[0] + p[1] * q[1]);
  }
  return angle < 2.0 * std::numbers::pi * (1.0 + 1e-9);
}

/** Counts a step of a loop that may be long. */
void PolygonTriangulation::count()
{
  constexpr std::uint64_t Often = 1 << 16;
  if (++this->Steps % Often == 0)
  {
    (*this->Poll)();
  }
}

bool PolygonTriangulation::overlaps() const
{
  double sum = 0.0;
  for (const Triangle& t : this->Triangles)
  {
    sum += std::abs(this->twiceArea(t[0], t[1], t[2]));
  }
  return this->Winds ||
         sum - this->TwiceArea > 1e-6 * std::max(this->TwiceArea, 1e-3 * this->Extent);
}

void PolygonTriangulation::cutEars()
{
  const auto count = static_cast<std::uint32_t>(this->Points.size());
  this->Triangles.clear();
  this->Version.assign(count, 0);
  this->Next.resize(count);
  this->Previous.resize(count);
  for (std::uint32_t k = 0; k < count; ++k)
  {
    this->Next[k] = k + 1 < count ? k + 1 : 0;
    this->Previous[k] = k > 0 ? k - 1 : count - 1;
  }
  this->buildStrips();
  // An ear that holds a corner may be free later: it is looked at again when no other is left. Then
  // flat ones come, and at last any corner.
  for (const double least : { FlatQuality, LineQuality, 0.0, Any })
  {
    this->LeastQuality = least;
    while (this->cutRound())
    {
    }
  }
}

/** Cuts off ears until none of those is left that there were, or that came; returns whether there
 * were any. */
bool PolygonTriangulation::cutRound()
{
  const std::size_t before = this->Triangles.size();
  const std::size_t all = this->Points.size() - 2;
  this->collectEars();
  while (!this->Ears.empty() && this->Triangles.size() < all)
  {
    std::pop_heap(this->Ears.begin(), this->Ears.end());
    const Ear ear = this->Ears.back();
    this->Ears.pop_back();
    if (ear.version == this->Version[ear.corner] && ear.quality > this->LeastQuality &&
        (this->LeastQuality == Any || !this->containsCorner(ear.corner)))
    {
      this->cutOff(ear.corner);
    }
    this->count();
  }
  return this->Triangles.size() > before && this->Triangles.size() < all;
}

/** Sorts the corners that are left into strips. */
void PolygonTriangulation::buildStrips()
{
  std::vector<std::uint32_t> left;
  for (std::uint32_t corner = 0; corner < this->Points.size(); ++corner)
  {
    if (this->Version[corner] != Gone)
    {
      left.push_back(corner);
    }
  }
  this->Strips.build(this->Points, std::move(left));
}

/** Collects the ears of all corners that are left. */
void PolygonTriangulation::collectEars()
{
  const std::size_t left = this->Points.size() - this->Triangles.size();
  if (2 * left <= this->Strips.size())
  {
    this->buildStrips();
  }
  this->Ears.clear();
  for (std::uint32_t corner = 0; corner < this->Points.size(); ++corner)
  {
    if (this->Version[corner] != Gone)
    {
      this->addEar(corner);
    }
  }
}

void PolygonTriangulation::addEar(std::uint32_t corner)
{
  const double quality = this->qualityOf(this->Previous[corner], corner, this->Next[corner]);
  this->Ears.push_back({ quality, corner, this->Version[corner] });
  std::push_heap(this->Ears.begin(), this->Ears.end());
}

/** Whether another corner that is not convex lies in the triangle of an ear or on its sides. */
bool PolygonTriangulation::containsCorner(std::uint32_t ear)
{
  const std::array<std::uint32_t, 3> corners{ this->Previous[ear], ear, this->Next[ear] };
  const Point& a = this->Points[corners[0]];
  const Point& b = this->Points[corners[1]];
  const Point& c = this->Points[corners[2]];
  // A corner beside a side, nearer than what counts as flat, would leave a flat triangle.
  const double square = std::max({ squareOf(a, b), squareOf(b, c), squareOf(c, a) });
  const double margin = this->LeastQuality * square;
  return this->Strips.anyOf({ a, b, c }, this->LeastQuality * std::sqrt(square),
    [&](std::uint32_t k)
    {
      this->count();
      const Point& p = this->Points[k];
      // Not corners at the same place, as of a hole that is joined to the outline by two sides.
      if (this->Version[k] == Gone || p == a || p == b || p == c)
      {
        return false;
      }
      const auto isLeft = [&p, margin](const Point& from, const Point& to)
      {
        return turn({ to[0] - from[0], to[1] - from[1] }, { p[0] - from[0], p[1] - from[1] }) >=
               -margin;
      };
      return isLeft(a, b) && isLeft(b, c) && isLeft(c, a) &&
             this->qualityOf(this->Previous[k], k, this->Next[k]) <= this->LeastQuality;
    });
}

void PolygonTriangulation::cutOff(std::uint32_t ear)
{
  const std::uint32_t before = this->Previous[ear];
  const std::uint32_t after = this->Next[ear];
  Triangle triangle{ before, ear, after };
  std::ranges::sort(triangle);
  this->Triangles.push_back(triangle);
  this->Next[before] = after;
  this->Previous[after] = before;
  this->Version[ear] = Gone;
  for (const std::uint32_t neighbour : { before, after })
  {
    ++this->Version[neighbour];
    this->addEar(neighbour);
  }
}

/** Of the triangle of three corners, positive if it turns as the polygon does. */
double PolygonTriangulation::twiceArea(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
{
  const Point& p = this->Points[a];
  const Point& q = this->Points[b];
  const Point& r = this->Points[c];
  return turn({ q[0] - p[0], q[1] - p[1] }, { r[0] - p[0], r[1] - p[1] });
}

/** Twice the area of the triangle by the square of its longest side. */
double PolygonTriangulation::qualityOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
{
  const Point& p = this->Points[a];
  const Point& q = this->Points[b];
  const Point& r = this->Points[c];
  const double square = std::max({ squareOf(p, q), squareOf(q, r), squareOf(r, p) });
  return square > 0.0 ? this->twiceArea(a, b, c) / square : 0.0;
}

} // namespace smg
