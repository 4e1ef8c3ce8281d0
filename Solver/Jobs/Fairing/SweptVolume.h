// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

namespace smg
{

/**
 * The volume that triangles sweep when their corners move from x to y + c n along straight lines,
 * as a polynomial of the distance c. Positive if they move to the side of their normals; of a
 * closed surface it is the difference of the enclosed volumes.
 */
class SweptVolume
{
public:
  /** Adds a triangle: the x, y, z of each corner before and after the motion, and its n. */
  void add(const double* const* x, const double* const* y, const double* const* n);

  /** The volume at the distance c. */
  double at(double c) const;
  /** The distance nearest to 0, of at most `most`, with which no volume is swept, by Newton's
   * method; none if that does not find it. */
  std::optional<double> root(double most) const;

private:
  double slope(double c) const;

  std::array<double, 4> Coefficients{}; ///< of 1, c, c^2, c^3
};

} // namespace smg
