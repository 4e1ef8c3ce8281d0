// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Preview/BodyCentredGrid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace smg
{

/**
 * Clusters of the vertices of a tetrahedral mesh, and the tetrahedra between them: those of the
 * mesh with corners in four clusters.
 *
 * A cluster is represented by its vertex nearest to the lattice point of its cell. The map of
 * vertices to clusters is a simplicial map: each tetrahedron of the mesh has an image, and the
 * images, with the signs of their orientations, cover the solid once. Images between the same
 * clusters are added up; where their sum is 0 the map folds the mesh, and no tetrahedron is there.
 */
class SolidClusters
{
public:
  using Point = std::array<double, 3>;
  using Tetrahedron = std::array<int, 4>;

  struct Cluster
  {
    std::int64_t id = 0; ///< stream index of the vertex that represents it
    Point point{};       ///< the position of this vertex
    double squared = 0.0;
  };

  /** Without a grid, every vertex is a cluster of its own. */
  explicit SolidClusters(const std::optional<BodyCentredGrid>& grid)
    : Grid(grid)
  {
  }

  /** The cluster of the next vertex. */
  int add(std::int64_t id, const Point& point);
  /** Adds a tetrahedron of the mesh with the clusters and the positions of its corners. */
  void add(const Tetrahedron& clusters, const std::array<Point, 4>& points);

  const std::vector<Cluster>& clusters() const { return this->Clusters; }

  /**
   * The tetrahedra between clusters, of positive orientation. Left out are those that are turned
   * over or flat, because the vertices that represent their clusters are not at the lattice points,
   * and parts of the solid that are thinner than the cells and hang together with no other.
   */
  std::vector<Tetrahedron> tetrahedra() const;

private:
  struct Hash
  {
    std::size_t operator()(const Tetrahedron& corners) const;
  };

  std::vector<Tetrahedron> withoutFragments(std::vector<Tetrahedron> all) const;

  std::optional<BodyCentredGrid> Grid;
  std::unordered_map<std::uint64_t, int> Index; ///< from the key of a cell to its cluster
  std::vector<Cluster> Clusters;
  /** From sorted clusters to the sum of the orientations of the images between them. */
  std::unordered_map<Tetrahedron, int, Hash> Images;
};

} // namespace smg
