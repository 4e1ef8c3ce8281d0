// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace smg
{

/** The weighted sum of the squared distances of a point from planes (Garland and Heckbert, Surface
 * simplification using quadric error metrics, 1997): x' A x + 2 b' x + c. */
struct Quadric
{
  std::array<double, 6> a{}; ///< xx, yy, zz, xy, xz, yz
  std::array<double, 3> b{};
  double c = 0.0;
  double weight = 0.0;

  /** Adds the plane through a point with this unit normal. */
  void addPlane(const double* normal, const double* point, double w)
  {
    const double x = normal[0], y = normal[1], z = normal[2];
    const double d = -(x * point[0] + y * point[1] + z * point[2]);
    this->add({ { w * x * x, w * y * y, w * z * z, w * x * y, w * x * z, w * y * z },
      { w * d * x, w * d * y, w * d * z }, w * d * d, w });
  }

  void add(const Quadric& other)
  {
    for (std::size_t k = 0; k < 6; ++k)
    {
      this->a[k] += other.a[k];
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->b[k] += other.b[k];
    }
    this->c += other.c;
    this->weight += other.weight;
  }

  /** The weighted mean of the squared distances of the point. */
  double squaredDistance(const double* p) const
  {
    const double x = p[0], y = p[1], z = p[2];
    const double sum = this->a[0] * x * x + this->a[1] * y * y + this->a[2] * z * z +
                       2.0 * (this->a[3] * x * y + this->a[4] * x * z + this->a[5] * y * z) +
                       2.0 * (this->b[0] * x + this->b[1] * y + this->b[2] * z) + this->c;
    return this->weight > 0.0 ? std::fabs(sum) / this->weight : 0.0;
  }
};

} // namespace smg
