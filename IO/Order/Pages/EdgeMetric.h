// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/CellSample.h"
#include "IO/Order/Pages/HilbertCurve.h"

#include <array>
#include <cstdint>

namespace smg
{

/**
 * Positions of vertices along a Hilbert curve, in coordinates in which the edges of a mesh are
 * about equally long in all directions, so that thin triangles, layers or a few distant points do
 * not separate neighbours.
 */
class EdgeMetric
{
public:
  /** From the edges and the extent of a sample with any finite coordinates. */
  explicit EdgeMetric(const CellSample& sample);

  template <class Real>
  std::uint64_t key(const Real* position) const
  {
    const double x = position[0], y = position[1], z = position[2];
    return this->Curve.key(
      this->coordinate(0, x, y, z), this->coordinate(1, x, y, z), this->coordinate(2, x, y, z));
  }

private:
  struct Axis
  {
    std::array<double, 3> direction{}; ///< its length is the scale
    double low = 0;
  };

  std::uint32_t coordinate(int k, double x, double y, double z) const
  {
    const Axis& axis = this->Axes[std::size_t(k)];
    const double value =
      axis.direction[0] * x + axis.direction[1] * y + axis.direction[2] * z - axis.low;
    // Written such that NaN becomes 0.
    return value > 0 ? (value < HilbertCurve::Largest ? static_cast<std::uint32_t>(value)
                                                      : HilbertCurve::Largest)
                     : 0;
  }

  HilbertCurve Curve;
  std::array<Axis, 3> Axes;
};

/**
 * Whether the numbers of the vertices represent neighbourhood clearly better than the positions
 * along the curve; `tolerance` is the allowed distance of the ranks of two neighbours, of
 * `vertices` ranks.
 */
bool numbersAreMoreLocal(
  const CellSample& sample, const EdgeMetric& metric, std::int64_t vertices, double tolerance);

} // namespace smg
