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
 *
 * As long as triangles come, the cells double, so that each is a part of one of the next grid, and
 * there are a few times more clusters than wanted. finish() joins these once, by the finest grid
 * that has no more than wanted.
 */
class ClusterGrid
{
public:
  /** A vertex that stands for its cluster. */
  struct Representative
  {
    std::int64_t id = 0; ///< stream index
    std::array<double, 3> point{};
    /** Sum of the normals of the triangles at the cluster's vertices, each as long as it is large.
     */
    std::array<double, 3> normal{};
  };

  /**
   * In the end at most `maximumClusters` (8 to 2^20) clusters. All vertices lie in the box `bounds`
   * (xmin, xmax, ...), or (`mayGrow`) that is some part of the mesh.
   */
  ClusterGrid(
    const std::array<double, 6>& bounds, std::int64_t maximumClusters, bool mayGrow = false);

  /** Clusters found before the grid last became coarser are void: see cluster(). */
  int generation() const { return this->Generation; }

  /**
   * The cluster of a vertex; valid as long as the generation is the same. May make the grid coarser
   * if that may grow.
   */
  int cluster(std::int64_t id, const std::array<double, 3>& point);

  /** Adds the triangle of three clusters, whose normal is as long as it is large. May make the grid
   * coarser. */
  void addTriangle(int a, int b, int c, const std::array<double, 3>& normal);

  /** After the last triangle: leaves no more clusters than wanted. */
  void finish();

  const std::vector<Representative>& clusters() const { return this->Clusters; }
  /** The triangles kept, as clusters. */
  const std::vector<std::array<int, 3>>& triangles() const { return this->Triangles; }

private:
  /** Bits of a cell's place along an axis, so that three of them make a key. */
  static constexpr int PlaceBits = 21;

  /** The place of the point along the axis, from 0 at the origin, in cells of that side. */
  double place(const std::array<double, 3>& point, int axis, double side) const;
  bool isWithin(const std::array<double, 3>& point) const;
  std::uint64_t keyOf(const std::array<double, 3>& point, double side) const;
  double distanceToCentre(const std::array<double, 3>& point) const;
  int find(const Representative& candidate);
  void keep(int a, int b, int c);
  /** Whether the cells can be made larger. */
  bool canGrow() const;
  /** Clusters anew in cells of that side. */
  void coarsen(double side);
  /** How many of the clusters there would be in cells of that side. */
  std::size_t countIn(double side) const;
  double fittingSide() const;

  std::array<double, 3> Origin{};
  double FinestSize = 1.0; ///< of a cell at the beginning
  double FinestCells;      ///< so many of them along the longest side of the bounds
  double Side = 1.0;       ///< of a cell, in finest cells
  std::size_t MaximumClusters;
  std::size_t Capacity; ///< most clusters before finish()
  bool MayGrow;
  int Generation = 0;
  std::unordered_map<std::uint64_t, int> Index;
  std::vector<Representative> Clusters;
  std::vector<std::array<int, 3>> Triangles;
  std::unordered_set<std::uint64_t> Known;
};

} // namespace smg
