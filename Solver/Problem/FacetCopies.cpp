// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/FacetCopies.h"

#include "Solver/Assembly/Facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

// Facets that are copies of each other: those of two sides of a periodic mesh, and those that two
// bodies have at the same place. Vertices alone do not do: where an interface of two bodies meets a
// periodic side, each side has two vertices at one place, and only their facets say which belong
// together.

namespace smg
{

namespace
{

/** Sorts the corners of a facet. */
FacetList::Facet ascending(FacetList::Facet facet)
{
  auto& [a, b, c] = facet;
  std::tie(a, b) = std::minmax({ a, b });
  std::tie(b, c) = std::minmax({ b, c });
  std::tie(a, b) = std::minmax({ a, b });
  return facet;
}

} // namespace

void FacetList::add(const std::int64_t* corners, const double* const* points)
{
  Facet facet{ None, None, None };
  std::copy_n(corners, this->Corners, facet.begin());
  this->Facets.push_back(ascending(facet));
  for (std::size_t k = 0; k < this->Corners; ++k)
  {
    this->Vertices.push_back({ corners[k], { points[k][0], points[k][1], points[k][2] } });
  }
  // Each vertex comes with several facets.
  constexpr std::size_t Least = 4096;
  if (this->Vertices.size() > std::max(Least, 2 * this->Known))
  {
    this->forgetRepeated();
  }
  this->Reserved.resize(static_cast<std::int64_t>(
    this->Facets.capacity() * sizeof(Facet) + this->Vertices.capacity() * sizeof(Vertex)));
}

void FacetList::forgetRepeated()
{
  std::ranges::sort(this->Vertices, {}, &Vertex::index);
  const auto repeated = std::ranges::unique(this->Vertices, {}, &Vertex::index);
  this->Vertices.erase(repeated.begin(), repeated.end());
  this->Known = this->Vertices.size();
}

void FacetList::finish()
{
  this->forgetRepeated();
  std::ranges::sort(this->Facets);
  const auto repeated = std::ranges::unique(this->Facets);
  this->Facets.erase(repeated.begin(), repeated.end());
}

const Vector& FacetList::point(std::int64_t vertex) const
{
  return std::ranges::lower_bound(this->Vertices, vertex, {}, &Vertex::index)->point;
}

Vector FacetList::centre(const Facet& facet) const
{
  Vector sum{};
  for (std::size_t k = 0; k < this->Corners; ++k)
  {
    const Vector& at = this->point(facet[k]);
    for (std::size_t d = 0; d < 3; ++d)
    {
      sum[d] += at[d] / static_cast<double>(this->Corners);
    }
  }
  return sum;
}

double FacetList::area(const Facet& facet) const
{
  const double* points[3] = {};
  for (std::size_t k = 0; k < this->Corners; ++k)
  {
    points[k] = this->point(facet[k]).data();
  }
  return facetArea(this->Corners == 2 ? CellType::Triangle : CellType::Tetrahedron, points);
}

std::pair<Vector, Vector> FacetList::bounds() const
{
  constexpr double Far = std::numeric_limits<double>::infinity();
  Vector low{ Far, Far, Far }, high{ -Far, -Far, -Far };
  for (const Vertex& vertex : this->Vertices)
  {
    for (std::size_t d = 0; d < 3; ++d)
    {
      low[d] = std::min(low[d], vertex.point[d]);
      high[d] = std::max(high[d], vertex.point[d]);
    }
  }
  return { low, high };
}

namespace
{

/** A direction that no lattice is likely to be at right angles to. */
constexpr Vector Direction{ 0.5377, 0.7113, 0.4527 };

/** Sets `corners` to the copies of the corners of a facet; false if it is no copy. */
bool matchCorners(const FacetList& first, const FacetList::Facet& a, const FacetList& second,
  const FacetList::Facet& b, const Vector& shift, double tolerance,
  std::array<std::int64_t, 3>& corners)
{
  corners = { FacetList::None, FacetList::None, FacetList::None };
  for (std::size_t i = 0; i < first.corners(); ++i)
  {
    const Vector& from = first.point(a[i]);
    double least = tolerance * tolerance;
    for (std::size_t j = 0; j < second.corners(); ++j)
    {
      const Vector& to = second.point(b[j]);
      double square = 0.0;
      for (std::size_t d = 0; d < 3; ++d)
      {
        const double step = to[d] - from[d] - shift[d];
        square += step * step;
      }
      if (square <= least)
      {
        least = square;
        corners[i] = b[j];
      }
    }
  }
  return ascending(corners) == b;
}

} // namespace

Vector shiftBetween(const FacetList& first, const FacetList& second)
{
  const auto [low, high] = first.bounds();
  const auto [otherLow, otherHigh] = second.bounds();
  Vector shift{};
  for (std::size_t d = 0; d < 3; ++d)
  {
    shift[d] = ((otherLow[d] - low[d]) + (otherHigh[d] - high[d])) / 2;
  }
  return shift;
}

double usualTolerance(const FacetList& first, const FacetList& second)
{
  constexpr double OfDiagonal = 1e-6;
  const auto diagonal = [](const FacetList& list)
  {
    const auto [low, high] = list.bounds();
    const Vector extent = difference(high.data(), low.data());
    return std::sqrt(dot(extent, extent));
  };
  return OfDiagonal * std::max(diagonal(first), diagonal(second));
}

FacetCopies findCopies(
  const FacetList& first, const FacetList& second, const Vector& shift, double tolerance)
{
  struct Projected
  {
    double at;
    std::size_t facet;
  };
  std::vector<Projected> sorted;
  sorted.reserve(second.facets().size());
  for (std::size_t f = 0; f < second.facets().size(); ++f)
  {
    sorted.push_back({ dot(Direction, second.centre(second.facets()[f])), f });
  }
  std::ranges::stable_sort(sorted, {}, &Projected::at);
  FacetCopies copies;
  for (std::size_t f = 0; f < first.facets().size(); ++f)
  {
    const FacetList::Facet& facet = first.facets()[f];
    const double at = dot(Direction, first.centre(facet)) + dot(Direction, shift);
    bool found = false;
    for (auto other = std::ranges::lower_bound(sorted, at - tolerance, {}, &Projected::at);
         !found && other != sorted.end() && other->at <= at + tolerance; ++other)
    {
      const FacetList::Facet& candidate = second.facets()[other->facet];
      FacetCopy copy{ f, other->facet, {} };
      // Bodies that share a vertex, as at the rim of a gap, are copies of each other there.
      found = candidate != facet &&
              matchCorners(first, facet, second, candidate, shift, tolerance, copy.corners);
      if (found)
      {
        copies.pairs.push_back(copy);
      }
    }
    if (!found)
    {
      copies.alone.push_back(f);
    }
  }
  return copies;
}

} // namespace smg
