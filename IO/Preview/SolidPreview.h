// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Preview.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace smg
{

/**
 * Creates a preview of a tetrahedral mesh: a coarse tetrahedral mesh of at most `maximumPoints`
 * points, each of them a vertex of the mesh, by vertex clustering on a body-centred cubic grid (see
 * SolidClusters). A mesh of so few vertices is returned as it is, without cells that have no
 * volume; of others there is at most one point for 20 vertices, since the cells of the grid must be
 * larger than those of the mesh. Parts that are thinner than two or three cells of the grid vanish.
 *
 * Reads the mesh twice, rarely a third time. Memory is bounded by the preview and by the window of
 * the stream. The columns of the vertices are not set. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makeSolidPreview(const StoredMesh& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

/**
 * The Voronoi cells of a body-centred cubic lattice: truncated octahedra. Along every edge of these
 * three cells meet, and at every corner four, whose lattice points span well-shaped tetrahedra, all
 * congruent (the tiling of Labelle and Shewchuk, Isosurface stuffing, 2007). Along the edges of a
 * cubic grid four cells meet, so that clusters of its cells would be joined by flat tetrahedra.
 */
class BodyCentredGrid
{
public:
  /** A cell, and the square of the distance of a point in it to its lattice point. */
  struct Place
  {
    std::uint64_t key = 0;
    double squared = 0.0;
  };

  /** A lattice with a point at `origin`, and cubes of the side `side`. Points may be at most 2^19
   * sides away from the origin. */
  BodyCentredGrid(const std::array<double, 3>& origin, double side)
    : Origin(origin)
    , Side(side)
  {
  }

  const std::array<double, 3>& origin() const { return this->Origin; }
  double side() const { return this->Side; }
  /** The volume of the tetrahedra that lattice points span. */
  double tetrahedronVolume() const { return this->Side * this->Side * this->Side / 12.0; }

  Place placeOf(const std::array<double, 3>& point) const
  {
    const Place corner = this->nearest(point, 0.0);
    const Place centre = this->nearest(point, 0.5);
    return corner.squared <= centre.squared ? corner : centre;
  }

private:
  /** The nearest lattice point of those that are shifted by `shift` cubes along each axis. */
  Place nearest(const std::array<double, 3>& point, double shift) const
  {
    constexpr int Bits = 21;
    Place place;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double at = (point[axis] - this->Origin[axis]) / this->Side;
      const double cube = std::round(at - shift) + shift;
      const double away = (at - cube) * this->Side;
      place.squared += away * away;
      // In half cubes, so that the coordinates of both kinds of points are integers.
      const auto number = static_cast<std::int64_t>(2.0 * cube) + (std::int64_t(1) << (Bits - 1));
      place.key = place.key << Bits | static_cast<std::uint64_t>(number);
    }
    return place;
  }

  std::array<double, 3> Origin;
  double Side;
};

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
