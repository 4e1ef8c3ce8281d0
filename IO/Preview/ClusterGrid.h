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
 * Vertex clustering on a uniform grid whose cells grow when there are too many of them: memory is
 * bounded by the requested number of clusters for any mesh.
 *
 * A cluster is represented by the vertex nearest to the centre of its grid cell, so its position is
 * one of the mesh. A triangle is kept if its corners are in three clusters, once for any three.
 *
 * While triangles are added, the cells double, so that each is part of a cell of the next grid,
 * with a few times more clusters than requested. finish() merges these once, with the finest grid
 * of at most the requested number.
 */
class ClusterGrid
{
public:
  /** The vertex that represents a cluster. */
  struct Representative
  {
    std::int64_t id = 0; ///< stream index
    std::array<double, 3> point{};
    /** The sum of the area-weighted normals of the triangles at the vertices of the cluster. */
    std::array<double, 3> normal{};
  };

  /** Creates at most `maximumClusters` (8 to 2^20) clusters. All vertices are in the box `bounds`
   * (xmin, xmax, ...), or, with `mayGrow`, it is the box of a part of the mesh. */
  ClusterGrid(
    const std::array<double, 6>& bounds, std::int64_t maximumClusters, bool mayGrow = false);

  /** Changes when the grid is coarsened, which invalidates clusters: see cluster(). */
  int generation() const { return this->Generation; }

  /** The cluster of a vertex, valid for the current generation. May coarsen the grid if that may
   * grow. */
  int cluster(std::int64_t id, const std::array<double, 3>& point);

  /** Adds the triangle of three clusters with its area-weighted normal. May coarsen the grid. */
  void addTriangle(int a, int b, int c, const std::array<double, 3>& normal);

  /** After the last triangle: merges clusters to at most the requested number. */
  void finish();

  const std::vector<Representative>& clusters() const { return this->Clusters; }
  /** The triangles kept, as clusters. */
  const std::vector<std::array<int, 3>>& triangles() const { return this->Triangles; }

private:
  /** Bits of the index of a cell along an axis, so that three of them form a key. */
  static constexpr int PlaceBits = 21;

  /** The coordinate of the point along the axis, from 0 at the origin, in cells of that side. */
  double place(const std::array<double, 3>& point, int axis, double side) const;
  bool isWithin(const std::array<double, 3>& point) const;
  std::uint64_t keyOf(const std::array<double, 3>& point, double side) const;
  double distanceToCentre(const std::array<double, 3>& point) const;
  int find(const Representative& candidate);
  void keep(int a, int b, int c);
  /** Whether the cells can be enlarged. */
  bool canGrow() const;
  /** Repeats the clustering with cells of that side. */
  void coarsen(double side);
  /** The number of clusters with cells of that side. */
  std::size_t countIn(double side) const;
  double fittingSide() const;

  std::array<double, 3> Origin{};
  double FinestSize = 1.0; ///< initial size of a cell
  double FinestCells;      ///< their number along the longest side of the bounds
  double Side = 1.0;       ///< of a cell, in finest cells
  std::size_t MaximumClusters;
  std::size_t Capacity; ///< maximum number of clusters before finish()
  bool MayGrow;
  int Generation = 0;
  std::unordered_map<std::uint64_t, int> Index;
  std::vector<Representative> Clusters;
  std::vector<std::array<int, 3>> Triangles;
  std::unordered_set<std::uint64_t> Known;
};

} // namespace smg
