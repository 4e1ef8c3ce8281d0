// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace smg
{

/** A vector in space. */
using Vector = std::array<double, 3>;

inline Vector difference(const double* a, const double* b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline Vector scaled(double factor, const Vector& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

/** K v of a symmetric tensor K = [xx, yy, zz, xy, yz, xz]. */
inline Vector product(const double* K, const Vector& v)
{
  return { K[0] * v[0] + K[3] * v[1] + K[5] * v[2], K[3] * v[0] + K[1] * v[1] + K[4] * v[2],
    K[5] * v[0] + K[4] * v[1] + K[2] * v[2] };
}

} // namespace smg
