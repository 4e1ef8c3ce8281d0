// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace smg
{

/**
 * Vertex clustering on a uniform grid whose cells grow when there are too many of them: the memory
 * is bounded by the number of clusters wanted, whatever the mesh.
 *
 * A cluster is represented by the vertex nearest to the centre of its grid cell, so its position is
 * one of the mesh. A triangle is kept if its corners lie in three clusters, once for any three.
 */
class ClusterGrid
{
public:
  /** A vertex that stands for its cluster. */
  struct Representative
  {
    std::int64_t id = 0; ///< stream index
    std::array<double, 3> point{};
  };

  /** Clusters of the box `bounds` (xmin, xmax, ...), at most `maximumClusters` (at least 8). */
  ClusterGrid(const std::array<double, 6>& bounds, std::int64_t maximumClusters);

  /** Clusters found before the grid last became coarser are void: see cluster(). */
  int generation() const { return this->Level; }

  /** The cluster of a vertex; valid as long as the generation is the same. */
  int cluster(std::int64_t id, const std::array<double, 3>& point);

  /** Adds the triangle of three clusters. May make the grid coarser. */
  void addTriangle(int a, int b, int c);

  const std::vector<Representative>& clusters() const { return this->Clusters; }
  /** The triangles kept, as clusters. */
  const std::vector<std::array<int, 3>>& triangles() const { return this->Triangles; }

private:
  /** Grid cells along the longest axis at level 0, as a power of two; each level halves them. */
  static constexpr int FinestBits = 10;

  std::uint64_t keyOf(const std::array<double, 3>& point) const;
  double distanceToCentre(const std::array<double, 3>& point) const;
  int find(const Representative& candidate);
  void keep(int a, int b, int c);
  void coarsen();

  std::array<double, 3> Origin{};
  double FinestSize = 1.0;
  std::size_t MaximumClusters;
  int Level = 0;
  std::unordered_map<std::uint64_t, int> Index;
  std::vector<Representative> Clusters;
  std::vector<std::array<int, 3>> Triangles;
  std::unordered_set<std::uint64_t> Known;
};

} // namespace smg
