// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/EdgeConductivity.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>

namespace smg
{

double EdgeConductivity::factor(double curvature) const
{
  const double turns = curvature * this->Length / this->Limit;
  // The least conductivity keeps K definite.
  return std::max(1.0 / (1.0 + turns * turns * turns * turns), 1e-6);
}

std::array<double, 6> EdgeConductivity::at(
  const double* const* points, const double* const* normals) const
{
  // Axes u, v of the plane, u along the first edge.
  const Vector ab = difference(points[1], points[0]);
  const Vector ac = difference(points[2], points[0]);
  const Vector area = cross(ab, ac);
  const double width = std::sqrt(dot(ab, ab));
  const Vector u = scaled(1.0 / width, ab);
  const Vector n = scaled(1.0 / std::sqrt(dot(area, area)), area);
  const Vector v = cross(n, u);
  const double cu = dot(ac, u);
  const double cv = dot(ac, v);

  // The normal turns by (b - a) / width along u, and so that it is c at the third corner.
  const Vector alongU = scaled(1.0 / width, difference(normals[1], normals[0]));
  const Vector toC = difference(normals[2], normals[0]);
  const Vector alongV{ (toC[0] - cu * alongU[0]) / cv, (toC[1] - cu * alongU[1]) / cv,
    (toC[2] - cu * alongU[2]) / cv };
  const double uu = dot(alongU, u);
  const double vv = dot(alongV, v);
  const double uv = 0.5 * (dot(alongU, v) + dot(alongV, u));

  const double mean = 0.5 * (uu + vv);
  const double half = std::hypot(0.5 * (uu - vv), uv);
  const double angle = 0.5 * std::atan2(uv, 0.5 * (uu - vv));
  const double first = this->factor(mean + half);
  const double second = this->factor(mean - half);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  std::array<double, 6> K{};
  constexpr int Entry[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 0, 2 } };
  for (std::size_t k = 0; k < 6; ++k)
  {
    const auto i = static_cast<std::size_t>(Entry[k][0]);
    const auto j = static_cast<std::size_t>(Entry[k][1]);
    const auto e = [&](std::size_t axis) { return c * u[axis] + s * v[axis]; };
    const auto f = [&](std::size_t axis) { return c * v[axis] - s * u[axis]; };
    K[k] = first * e(i) * e(j) + second * f(i) * f(j) + n[i] * n[j];
  }
  return K;
}

} // namespace smg
