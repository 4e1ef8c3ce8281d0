// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/SurfaceBinding.h"

#include "IO/Results/VertexNormals.h"
#include "Solver/Core/DisjointSets.h"
#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace smg
{
namespace
{

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

Vector unit(const Vector& v)
{
  const double length = std::sqrt(dot(v, v));
  return length > 0.0 ? scaled(1.0 / length, v) : Vector{};
}

/** About the weights of the corners of a triangle at a point of it. */
std::array<double, 3> weightsAt(const TrianglePoints& triangle, const double* point)
{
  const auto& [a, b, c] = triangle.point;
  const Vector ab = difference(b, a), ac = difference(c, a), ap = difference(point, a);
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const double area = bb * cc - bc * bc;
  // Of a triangle without area it is a point of the longer edge.
  constexpr double Flat = 1e-12;
  if (!(area > Flat * bb * cc))
  {
    const bool isB = bb >= cc;
    const double length = std::max(bb, cc);
    const double along = length > 0.0 ? dot(ap, isB ? ab : ac) / length : 0.0;
    const double share = std::clamp(along, 0.0, 1.0);
    return { 1.0 - share, isB ? share : 0.0, isB ? 0.0 : share };
  }
  const double pb = dot(ap, ab), pc = dot(ap, ac);
  const double ofB = std::clamp((cc * pb - bc * pc) / area, 0.0, 1.0);
  const double ofC = std::clamp((bb * pc - bc * pb) / area, 0.0, 1.0 - ofB);
  return { 1.0 - ofB - ofC, ofB, ofC };
}

/** For each vertex, its neighbours by the edges of triangles, some twice. */
struct Neighbours
{
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> all;

  Neighbours(std::size_t vertices, std::span<const std::int64_t> corners)
    : begin(vertices + 2, 0)
    , all(2 * corners.size())
  {
    for (const std::int64_t corner : corners)
    {
      this->begin[static_cast<std::size_t>(corner) + 2] += 2;
    }
    std::partial_sum(this->begin.begin(), this->begin.end(), this->begin.begin());
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      std::size_t& end = this->begin[static_cast<std::size_t>(corners[i]) + 1];
      for (const std::size_t k : { i % 3 == 2 ? i - 2 : i + 1, i % 3 == 0 ? i + 2 : i - 1 })
      {
        this->all[end++] = static_cast<std::uint32_t>(corners[k]);
      }
    }
  }

  std::span<const std::uint32_t> of(std::uint32_t v) const
  {
    return { this->all.data() + this->begin[v], this->begin[v + 1] - this->begin[v] };
  }
};

} // namespace

SurfaceBinding::SurfaceBinding(std::span<const double> points,
  std::span<const std::int64_t> corners, const CoarserSurface& coarser)
  : Coarser(coarser)
  , Begin(coarser.vertices.size() + 2, 0)
  , Around(coarser.corners.size())
{
  for (const std::int64_t corner : coarser.corners)
  {
    ++this->Begin[static_cast<std::size_t>(corner) + 2];
  }
  std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
  for (std::size_t i = 0; i < coarser.corners.size(); ++i)
  {
    this->Around[this->Begin[static_cast<std::size_t>(coarser.corners[i]) + 1]++] =
      static_cast<std::uint32_t>(i / 3);
  }
  for (const std::int64_t v : coarser.vertices)
  {
    const double* p = points.data() + 3 * v;
    this->Places.insert(this->Places.end(), p, p + 3);
  }
  this->Frames = this->framesOf(this->Places);
  const std::vector<std::uint32_t> nearest = this->nearestAlongEdges(points, corners);
  this->findLooseBodies(points, corners, nearest);
  this->Bonds.reserve(nearest.size());
  for (std::size_t v = 0; v < nearest.size(); ++v)
  {
    this->Bonds.push_back(
      nearest[v] == None ? Bond{} : this->bondOf(points.data() + 3 * v, nearest[v]));
  }
}

/** The frames at the coarser vertices where they are at these places. */
std::vector<SurfaceBinding::Frame> SurfaceBinding::framesOf(std::span<const double> places) const
{
  const std::vector<double> sums = normalSums({ places, this->Coarser.corners, {} });
  std::vector<Frame> frames(this->Coarser.vertices.size());
  for (std::uint32_t v = 0; v < frames.size(); ++v)
  {
    Vector edge{};
    if (const std::span<const std::uint32_t> triangles = this->around(v); !triangles.empty())
    {
      const std::int64_t* c = this->Coarser.corners.data() + 3 * std::size_t(triangles.front());
      edge = difference(places.data() + 3 * (c[0] == v ? c[1] : c[0]), places.data() + 3 * v);
    }
    const Vector normal = unit({ sums[3 * v], sums[3 * v + 1], sums[3 * v + 2] });
    const Vector along = scaled(dot(edge, normal), normal);
    const Vector tangent = unit(difference(edge.data(), along.data()));
    const Vector third = cross(normal, tangent);
    for (std::size_t k = 0; k < 3; ++k)
    {
      frames[v][k] = tangent[k];
      frames[v][3 + k] = third[k];
      frames[v][6 + k] = normal[k];
    }
  }
  return frames;
}

/** For each vertex the place of the coarser vertex that is nearest along edges, by Dijkstra's
 * algorithm; None where there is none. */
std::vector<std::uint32_t> SurfaceBinding::nearestAlongEdges(
  std::span<const double> points, std::span<const std::int64_t> corners) const
{
  const std::size_t vertices = points.size() / 3;
  const Neighbours neighbours(vertices, corners);
  std::vector<std::uint32_t> nearest(vertices, None);
  std::vector<double> length(vertices, std::numeric_limits<double>::infinity());
  using Arrival = std::pair<double, std::uint32_t>;
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> front;
  for (std::uint32_t c = 0; c < this->Coarser.vertices.size(); ++c)
  {
    const auto v = static_cast<std::uint32_t>(this->Coarser.vertices[c]);
    nearest[v] = c;
    length[v] = 0.0;
    front.emplace(0.0, v);
  }
  while (!front.empty())
  {
    const auto [at, v] = front.top();
    front.pop();
    if (at > length[v])
    {
      continue;
    }
    for (const std::uint32_t w : neighbours.of(v))
    {
      const Vector edge =
        difference(points.data() + 3 * std::size_t(v), points.data() + 3 * std::size_t(w));
      const double there = at + std::sqrt(dot(edge, edge));
      if (there < length[w])
      {
        length[w] = there;
        nearest[w] = nearest[v];
        front.emplace(there, w);
      }
    }
  }
  return nearest;
}

void SurfaceBinding::findLooseBodies(std::span<const double> points,
  std::span<const std::int64_t> corners, std::span<const std::uint32_t> nearest)
{
  DisjointSets<std::uint32_t> bodies(nearest.size());
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    for (const std::size_t k : { i + 1, i + 2 })
    {
      bodies.join(static_cast<std::uint32_t>(corners[i]), static_cast<std::uint32_t>(corners[k]));
    }
  }
  std::vector<std::uint32_t> places(nearest.size(), None); // of the first one of each body
  for (std::uint32_t v = 0; v < nearest.size(); ++v)
  {
    if (nearest[v] == None)
    {
      std::uint32_t& place = places[bodies.first(v)];
      place = std::min(place, static_cast<std::uint32_t>(this->LooseVertices.size()));
      const double* p = points.data() + 3 * std::size_t(v);
      this->LooseVertices.push_back({ v, place, { p[0], p[1], p[2] } });
    }
  }
}

/** Moves those vertices of the bodies that are not held. */
void SurfaceBinding::moveLooseBodies(
  std::span<const std::uint8_t> held, std::vector<double>& places) const
{
  struct Shift
  {
    std::array<double, 3> sum{};
    double count = 0.0;
  };
  std::vector<Shift> shifts(this->LooseVertices.size());
  const auto isHeld = [&held](std::uint32_t v) { return !held.empty() && held[v] != 0; };
  for (const auto& [v, body, before] : this->LooseVertices)
  {
    if (isHeld(v))
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        shifts[body].sum[axis] += places[3 * std::size_t(v) + axis] - before[axis];
      }
      ++shifts[body].count;
    }
  }
  for (const auto& [v, body, before] : this->LooseVertices)
  {
    const Shift& shift = shifts[body];
    for (std::size_t axis = 0; axis < 3 && !isHeld(v); ++axis)
    {
      places[3 * std::size_t(v) + axis] =
        before[axis] + (shift.count > 0.0 ? shift.sum[axis] / shift.count : 0.0);
    }
  }
}

/** How a point is bound to the triangles around a coarser vertex and its neighbours. */
SurfaceBinding::Bond SurfaceBinding::bondOf(const double* point, std::uint32_t nearest) const
{
  Bond bond{ { nearest, nearest, nearest }, { 1.0, 0.0, 0.0 },
    difference(point, this->Places.data() + 3 * std::size_t(nearest)) };
  double least = dot(bond.offset, bond.offset);
  const auto lookAround = [&](std::uint32_t vertex)
  {
    for (const std::uint32_t t : this->around(vertex))
    {
      const std::int64_t* c = this->Coarser.corners.data() + 3 * std::size_t(t);
      TrianglePoints triangle;
      for (std::size_t k = 0; k < 3; ++k)
      {
        std::copy_n(this->Places.begin() + 3 * c[k], 3, triangle.point[k]);
      }
      const Vector at = nearestPoint(triangle, point);
      const Vector offset = difference(point, at.data());
      if (dot(offset, offset) < least)
      {
        least = dot(offset, offset);
        bond = { { static_cast<std::uint32_t>(c[0]), static_cast<std::uint32_t>(c[1]),
                   static_cast<std::uint32_t>(c[2]) },
          weightsAt(triangle, at.data()), {} };
      }
    }
  };
  if (least > 0.0)
  {
    for (const std::uint32_t t : this->around(nearest))
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        lookAround(static_cast<std::uint32_t>(this->Coarser.corners[3 * std::size_t(t) + k]));
      }
    }
  }
  // From the point with these weights, so that it is where it was as long as nothing moves.
  bond.offset = { point[0], point[1], point[2] };
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      bond.offset[axis] -= bond.weights[i] * this->Places[3 * std::size_t(bond.to[i]) + axis];
    }
  }
  return bond;
}

/** An offset as the surface turns from one frame to another; as it is where one has no normal. */
Vector SurfaceBinding::turned(const Frame& before, const Frame& after, const Vector& offset)
{
  const auto column = [](const Frame& frame, std::size_t k) {
    return Vector{ frame[3 * k], frame[3 * k + 1], frame[3 * k + 2] };
  };
  Vector sum{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vector from = column(before, k), to = column(after, k);
    if (dot(from, from) == 0.0 || dot(to, to) == 0.0)
    {
      return offset;
    }
    const double along = dot(from, offset);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum[axis] += along * to[axis];
    }
  }
  return sum;
}

std::vector<double> SurfaceBinding::follow(std::span<const double> moved,
  std::span<const std::uint8_t> held, std::span<const double> targets) const
{
  const std::vector<Frame> frames = this->framesOf(moved);
  std::vector<double> places;
  places.reserve(3 * this->Bonds.size());
  for (const Bond& bond : this->Bonds)
  {
    Vector place{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::uint32_t c = bond.to[i];
      const Vector offset = turned(this->Frames[c], frames[c], bond.offset);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] += bond.weights[i] * (moved[3 * std::size_t(c) + axis] + offset[axis]);
      }
    }
    places.insert(places.end(), place.begin(), place.end());
  }
  for (std::size_t v = 0; v < held.size(); ++v)
  {
    if (held[v] != 0)
    {
      std::ranges::copy(
        targets.subspan(3 * v, 3), places.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  }
  this->moveLooseBodies(held, places);
  return places;
}

} // namespace smg
