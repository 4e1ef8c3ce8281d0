// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/WindingRays.h"

#include <algorithm>
#include <numeric>

// A ray meets a triangle where the projection of the triangle along x has a winding number around
// that of the ray: the sum over its edges, of which those count that cross the line from there in
// the direction of +y. Two triangles at an edge decide by the same operations whether it crosses,
// so that a ray that meets an edge or a vertex is counted once, whatever the rounding.

namespace smg
{
namespace
{

/** How often the projection of the edge from a to b crosses the line from that of p on, upwards. */
int crossings(const Vector& a, const Vector& b, const Vector& p)
{
  const bool rises = b[2] > p[2];
  if ((a[2] > p[2]) == rises)
  {
    return 0;
  }
  const Vector& low = rises ? a : b;
  const Vector& high = rises ? b : a;
  const auto [left, right] = std::minmax(a[1], b[1]);
  const bool isAhead = p[1] < left || (p[1] <= right && (high[1] - low[1]) * (p[2] - low[2]) >
                                                          (p[1] - low[1]) * (high[2] - low[2]));
  return !isAhead ? 0 : rises ? 1 : -1;
}

/** Whether a triangle that the line through p meets does so beyond it. */
bool isBeyond(const Vector& a, const Vector& b, const Vector& c, const Vector& p)
{
  if (std::min({ a[0], b[0], c[0] }) > p[0])
  {
    return true;
  }
  const Vector normal = cross(difference(b.data(), a.data()), difference(c.data(), a.data()));
  const double ahead = dot(normal, difference(a.data(), p.data()));
  return normal[0] > 0.0 ? ahead > 0.0 : ahead < 0.0;
}

} // namespace

std::size_t WindingRays::addPoint(const Vector& point)
{
  this->Points.push_back(point);
  return this->Points.size() - 1;
}

void WindingRays::sort()
{
  this->Windings.assign(this->Points.size(), 0);
  this->ByHeight.resize(this->Points.size());
  std::iota(this->ByHeight.begin(), this->ByHeight.end(), 0U);
  std::ranges::stable_sort(
    this->ByHeight, {}, [this](std::uint32_t point) { return this->Points[point][2]; });
}

void WindingRays::count(const Vector& a, const Vector& b, const Vector& c)
{
  const auto [least, most] = std::minmax({ a[2], b[2], c[2] });
  const auto [left, right] = std::minmax({ a[1], b[1], c[1] });
  const double farthest = std::max({ a[0], b[0], c[0] });
  for (auto next = std::ranges::lower_bound(
         this->ByHeight, least, {}, [this](std::uint32_t point) { return this->Points[point][2]; });
       next != this->ByHeight.end(); ++next)
  {
    const Vector& p = this->Points[*next];
    if (p[2] > most)
    {
      break;
    }
    if (p[1] < left || p[1] > right || farthest <= p[0])
    {
      continue;
    }
    const int crossed = crossings(a, b, p) + crossings(b, c, p) + crossings(c, a, p);
    if (crossed != 0 && isBeyond(a, b, c, p))
    {
      this->Windings[*next] += crossed;
    }
  }
}

} // namespace smg
