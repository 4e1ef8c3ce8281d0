// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/SolidClusters.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace smg
{
namespace
{

using SolidPoint = SolidClusters::Point;

/** Tetrahedra with less than this share of the volume between lattice points are flat: their
 * weights would exceed all others. */
constexpr double LeastVolume = 0.05;

/** The number of tetrahedra between lattice points that meet at one of them. */
constexpr std::size_t AroundAPoint = 24;

double signedVolume(
  const SolidPoint& a, const SolidPoint& b, const SolidPoint& c, const SolidPoint& d)
{
  const auto edge = [&a](const SolidPoint& p) { return difference(p.data(), a.data()); };
  return dot(edge(b), cross(edge(c), edge(d))) / 6.0;
}

/** Sorts the clusters. Returns 1 if the permutation is even, -1 if it is odd. */
int sortClusters(SolidClusters::Tetrahedron& clusters)
{
  int sign = 1;
  for (std::size_t end = clusters.size(); end > 1; --end)
  {
    for (std::size_t i = 1; i < end; ++i)
    {
      if (clusters[i - 1] > clusters[i])
      {
        std::swap(clusters[i - 1], clusters[i]);
        sign = -sign;
      }
    }
  }
  return sign;
}

/** Numbers that are joined to sets: a forest, in which a root is its own parent. */
class ClusterSets
{
public:
  explicit ClusterSets(std::size_t count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }

  int root(int i)
  {
    while (this->parent(i) != i)
    {
      i = this->parent(i) = this->parent(this->parent(i));
    }
    return i;
  }
  void join(int i, int j) { this->parent(this->root(i)) = this->root(j); }

private:
  int& parent(int i) { return this->Parent[static_cast<std::size_t>(i)]; }

  std::vector<int> Parent;
};

} // namespace

std::size_t SolidClusters::Hash::operator()(const Tetrahedron& corners) const
{
  std::uint64_t hash = 0;
  for (const int corner : corners)
  {
    hash = (hash ^ static_cast<std::uint64_t>(corner)) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return hash;
}

int SolidClusters::add(std::int64_t id, const Point& point)
{
  const int next = static_cast<int>(this->Clusters.size());
  const BodyCentredGrid::Place place =
    this->Grid ? this->Grid->placeOf(point) : BodyCentredGrid::Place{};
  const int cluster = this->Grid ? this->Index.try_emplace(place.key, next).first->second : next;
  if (cluster == next)
  {
    this->Clusters.push_back({ id, point, place.squared });
  }
  else if (Cluster& present = this->Clusters[static_cast<std::size_t>(cluster)];
           place.squared < present.squared)
  {
    present = { id, point, place.squared };
  }
  return cluster;
}

void SolidClusters::add(const Tetrahedron& clusters, const std::array<Point, 4>& points)
{
  Tetrahedron sorted = clusters;
  const int sign = sortClusters(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
  {
    return;
  }
  const double size = signedVolume(points[0], points[1], points[2], points[3]);
  if (size != 0.0)
  {
    this->Images[sorted] += size > 0.0 ? sign : -sign;
  }
}

std::vector<SolidClusters::Tetrahedron> SolidClusters::tetrahedra() const
{
  const double least = this->Grid ? LeastVolume * this->Grid->tetrahedronVolume() : 0.0;
  const auto point = [this](int cluster) -> const Point&
  { return this->Clusters[static_cast<std::size_t>(cluster)].point; };
  std::vector<Tetrahedron> kept;
  for (const auto& [corners, orientation] : this->Images)
  {
    Tetrahedron turned = corners;
    if (orientation < 0)
    {
      std::swap(turned[2], turned[3]);
    }
    if (orientation != 0 && signedVolume(point(turned[0]), point(turned[1]), point(turned[2]),
                              point(turned[3])) > least)
    {
      kept.push_back(turned);
    }
  }
  // In an order that does not depend on the hash table.
  std::ranges::sort(kept);
  return this->Grid ? this->withoutFragments(std::move(kept)) : kept;
}

std::vector<SolidClusters::Tetrahedron> SolidClusters::withoutFragments(
  std::vector<Tetrahedron> all) const
{
  ClusterSets sets(this->Clusters.size());
  for (const Tetrahedron& corners : all)
  {
    for (const int corner : corners)
    {
      sets.join(corners[0], corner);
    }
  }
  std::vector<std::size_t> sizes(this->Clusters.size(), 0);
  std::size_t largest = 0;
  for (const Tetrahedron& corners : all)
  {
    largest = std::max(largest, ++sizes[static_cast<std::size_t>(sets.root(corners[0]))]);
  }
  const std::size_t least = std::min(AroundAPoint, largest);
  std::erase_if(all, [&](const Tetrahedron& corners)
    { return sizes[static_cast<std::size_t>(sets.root(corners[0]))] < least; });
  return all;
}

} // namespace smg
