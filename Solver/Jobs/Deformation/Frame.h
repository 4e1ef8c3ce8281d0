// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace smg
{

/** The rotation and scale of the mesh at a vertex, as the matrix s R - I, row by row. */
struct Frame
{
  double m[9];

  /** Component `r` of (s R - I) d. */
  double change(int r, const double* d) const
  {
    const double* row = this->m + 3 * r;
    return row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
  }
};

/**
 * s R - I of a rotation vector (unit axis times angle in radians) and the logarithm of s: R - I =
 * sin(a)/a K + (1 - cos(a))/a^2 K^2 (Rodrigues), K the cross product with the vector. Equally
 * accurate for small angles and scales near 1; exactly zero for four zeros.
 */
inline Frame frameOf(const double* rotationAndLogScale)
{
  const double x = rotationAndLogScale[0];
  const double y = rotationAndLogScale[1];
  const double z = rotationAndLogScale[2];
  const double growth = std::expm1(rotationAndLogScale[3]);
  const double square = x * x + y * y + z * z;
  const double angle = std::sqrt(square);
  // Below this angle the second terms of the series are smaller than the rounding of the first.
  constexpr double Small = 1e-8;
  const double half = std::sin(0.5 * angle);
  const double s = (1.0 + growth) * (angle < Small ? 1.0 : std::sin(angle) / angle);
  const double c = (1.0 + growth) * (angle < Small ? 0.5 : 2.0 * half * half / square);
  return { { growth - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y, c * x * y + s * z,
    growth - c * (x * x + z * z), c * y * z - s * x, c * x * z - s * y, c * y * z + s * x,
    growth - c * (x * x + y * y) } };
}

} // namespace smg
