// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace smg
{

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

} // namespace smg
