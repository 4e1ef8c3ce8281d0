// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/VertexClusters.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

// Merging of the vertices in each cell of a grid (Rossignac and Borrel, Multi-resolution 3D
// approximations for rendering complex scenes, 1993) to that one of them which is nearest to the
// planes of all (Lindstrom, Out-of-core simplification of large polygonal models, 2000).
//
// The cells are as small as the number of vertices allows, which is found by bisection: each step
// takes linear time. Every loop asks whether it is to go on.

namespace smg
{
namespace
{

/** The share of the squared distance from the middle of its cluster that is added to the squared
 * error of a vertex: of equal ones, as in flat regions, the one in the middle is left. */
constexpr double MiddleShare = 1e-3;
/** Most cells along an axis: three numbers of cells are 63 bits. */
constexpr double MostCells = 2097151.0;

class Clusters
{
public:
  Clusters(const SurfacePart& part, std::span<const std::uint8_t> held, const Poll& poll)
    : Part(part)
    , Polled(poll)
    , Cluster(part.vertices())
    , Keys(std::bit_ceil(2 * part.vertices() + 1))
    , Numbers(this->Keys.size())
  {
    if (!held.empty())
    {
      this->keepHeld(held);
    }
    std::array<double, 3> high{};
    for (std::size_t i = 0; i < part.points.size(); ++i)
    {
      poll.at(i);
      const std::size_t axis = i % 3;
      this->Low[axis] = i < 3 ? part.points[i] : std::min(this->Low[axis], part.points[i]);
      high[axis] = i < 3 ? part.points[i] : std::max(high[axis], part.points[i]);
      this->Extent = std::max(this->Extent, high[axis] - this->Low[axis]);
    }
  }

  /** Puts the vertices into so many cells along the longest axis. Returns the number of those that
   * are left of the triangles. */
  std::size_t assign(double cells)
  {
    constexpr std::uint64_t Free = std::numeric_limits<std::uint64_t>::max();
    std::ranges::fill(this->Keys, Free);
    const std::size_t mask = this->Keys.size() - 1;
    this->Count = 0;
    for (std::size_t v = 0; v < this->Cluster.size(); ++v)
    {
      this->Polled.at(v);
      const std::uint64_t key = this->keyOf(v, cells);
      std::uint64_t hash = key * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
      std::size_t place = hash & mask;
      while (this->Keys[place] != key && this->Keys[place] != Free)
      {
        place = (place + 1) & mask;
      }
      if (this->Keys[place] == Free)
      {
        this->Keys[place] = key;
        this->Numbers[place] = static_cast<std::uint32_t>(this->Count++);
      }
      this->Cluster[v] = this->Numbers[place];
    }
    this->IsUsed.assign(this->Count, 0);
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    for (std::size_t i = 0; i < corners.size(); i += 3)
    {
      this->Polled.at(i / 3);
      const std::uint32_t a = this->Cluster[corners[i]], b = this->Cluster[corners[i + 1]],
                          c = this->Cluster[corners[i + 2]];
      if (a != b && b != c && c != a)
      {
        this->IsUsed[a] = this->IsUsed[b] = this->IsUsed[c] = 1;
      }
    }
    return static_cast<std::size_t>(std::ranges::count(this->IsUsed, 1));
  }

  /** The number of vertices that are all of their clusters, whatever the cells are. */
  std::size_t own() const { return static_cast<std::size_t>(std::ranges::count(this->IsOwn, 1)); }

  /** For each vertex the one that is left of its cluster. */
  std::vector<std::uint32_t> places() const
  {
    constexpr double Far = std::numeric_limits<double>::infinity();
    std::vector<Quadric> planes(this->Count);
    std::vector<std::array<double, 4>> middles(this->Count);
    const bool hasPlanes = !this->Part.quadrics.empty();
    for (std::size_t v = 0; v < this->Cluster.size(); ++v)
    {
      this->Polled.at(v);
      const std::uint32_t cluster = this->Cluster[v];
      if (hasPlanes)
      {
        planes[cluster].add(this->Part.quadrics[v]);
      }
      std::array<double, 4>& middle = middles[cluster];
      const Vector at = this->at(v);
      middle[3] += 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        middle[axis] += (at[axis] - middle[axis]) / middle[3];
      }
    }
    std::vector<std::pair<double, std::uint32_t>> best(this->Count, { Far, 0 });
    for (std::uint32_t v = 0; v < this->Cluster.size(); ++v)
    {
      this->Polled.at(v);
      const std::uint32_t cluster = this->Cluster[v];
      const Vector at = this->at(v), away = difference(at.data(), middles[cluster].data());
      const double error =
        planes[cluster].squaredDistance(at.data()) + MiddleShare * dot(away, away);
      best[cluster] = std::min(best[cluster], { error, v });
    }
    std::vector<std::uint32_t> places(this->Cluster.size());
    std::ranges::transform(this->Cluster, places.begin(),
      [&best](std::uint32_t cluster) { return best[cluster].second; });
    return places;
  }

private:
  /** A vertex of a triangle with a held corner is a cluster of its own, so that the held one keeps
   * its triangles. */
  void keepHeld(std::span<const std::uint8_t> held)
  {
    this->IsOwn.assign(this->Part.vertices(), 0);
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    for (std::size_t i = 0; i < corners.size(); i += 3)
    {
      this->Polled.at(i / 3);
      const bool isOwn = (held[corners[i]] | held[corners[i + 1]] | held[corners[i + 2]]) != 0;
      for (std::size_t k = i; isOwn && k < i + 3; ++k)
      {
        this->IsOwn[corners[k]] = 1;
      }
    }
  }

  std::uint64_t keyOf(std::size_t v, double cells) const
  {
    if (!this->IsOwn.empty() && this->IsOwn[v] != 0)
    {
      return std::uint64_t(1) << 63 | v; // no key of a cell, which has 63 bits
    }
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double share =
        this->Extent > 0.0 ? (this->Part.points[3 * v + axis] - this->Low[axis]) / this->Extent : 0;
      key = key << 21 | static_cast<std::uint64_t>(std::min(share * cells, MostCells));
    }
    return key;
  }

  /** The point relative to that of the quadrics. */
  Vector at(std::size_t v) const
  {
    return difference(this->Part.point(v), this->Part.origin.data());
  }

  const SurfacePart& Part;
  const Poll& Polled;
  std::array<double, 3> Low{};
  double Extent = 0.0;
  std::vector<std::uint8_t> IsOwn;    ///< for each vertex whether it is all of its cluster
  std::vector<std::uint32_t> Cluster; ///< of each vertex
  std::size_t Count = 0;              ///< of clusters
  std::vector<std::uint8_t> IsUsed;   ///< of each cluster
  // A hash table of the cells.
  std::vector<std::uint64_t> Keys;
  std::vector<std::uint32_t> Numbers;
};

/** The most cells along the longest axis with which at most `vertices` are left, nearly. */
double cellsFor(Clusters& clusters, std::size_t vertices)
{
  constexpr int Steps = 40;
  const std::size_t enough = vertices - vertices / 50;
  double low = 0.5, high = MostCells;
  for (int step = 0; step < Steps && high > low * 1.001; ++step)
  {
    // The number grows with a power of the cells.
    const double middle = std::sqrt(low * high);
    const std::size_t left = clusters.assign(middle);
    (left <= vertices ? low : high) = middle;
    if (left >= enough && left <= vertices)
    {
      break;
    }
  }
  return low;
}

/** Moves the corners of triangles to other vertices; those with two at one vertex, and all but the
 * first of those with the same corners, go. */
void moveCorners(SurfacePart& part, const std::vector<std::uint32_t>& places, const Poll& poll)
{
  std::set<std::array<std::uint32_t, 3>> known;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < part.corners.size(); i += 3)
  {
    poll.at(i / 3);
    const std::array<std::uint32_t, 3> moved{ places[part.corners[i]], places[part.corners[i + 1]],
      places[part.corners[i + 2]] };
    std::array<std::uint32_t, 3> sorted = moved;
    std::ranges::sort(sorted);
    if (sorted[0] != sorted[1] && sorted[1] != sorted[2] && known.insert(sorted).second)
    {
      part.moveTriangle(i / 3, kept);
      std::ranges::copy(moved, part.corners.begin() + 3 * static_cast<std::ptrdiff_t>(kept++));
    }
  }
  part.keepTriangles(kept);
}

} // namespace

void clusterVertices(
  SurfacePart& part, std::span<const std::uint8_t> held, std::size_t vertices, const Poll& poll)
{
  if (part.vertices() <= vertices)
  {
    return;
  }
  Clusters clusters(part, held, poll);
  // What is held must not take the place of all others.
  clusters.assign(cellsFor(clusters, std::max(vertices, clusters.own() + vertices / 8)));
  const std::vector<std::uint32_t> places = clusters.places();
  for (std::size_t v = 0; v < places.size() && !part.quadrics.empty(); ++v)
  {
    poll.at(v);
    // A vertex that is left stands for all of its cluster.
    if (places[v] != v)
    {
      part.quadrics[places[v]].add(part.quadrics[v]);
      part.lacksBoundary[places[v]] |= part.lacksBoundary[v];
    }
  }
  moveCorners(part, places, poll);
  part.dropUnusedVertices(poll);
}

} // namespace smg
