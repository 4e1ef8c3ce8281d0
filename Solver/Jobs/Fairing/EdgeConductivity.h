// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace smg
{

/**
 * The conductivity of anisotropic geometric diffusion (Clarenz, Diewald and Rumpf 2000), which is
 * small across edges and 1 along them. The gradient of the unit normals, linear in a triangle, is
 * its shape operator. The surface turns by the angle phi = |kappa| * length along a principal
 * direction e of curvature kappa; K is the sum of e e^T / (1 + (phi / limit)^4) over the two
 * directions, at least 1e-6 each, and 1 along the normal.
 */
class EdgeConductivity
{
public:
  /** `length` over which the surface turns, in the unit of the mesh; `limit` in radians. */
  EdgeConductivity(double length, double limit)
    : Length(length)
    , Limit(limit)
  {
  }

  /** K as xx, yy, zz, xy, yz, xz for a triangle with an area, of these corners with these unit
   * normals. */
  std::array<double, 6> at(const double* const* points, const double* const* normals) const;

private:
  double factor(double curvature) const;

  double Length, Limit;
};

} // namespace smg
