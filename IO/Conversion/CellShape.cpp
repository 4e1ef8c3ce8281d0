// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/CellShape.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

using Vector = std::array<double, 3>;

/** Twice the area or six times the volume is this share of the longest edge's square or cube. */
constexpr double Flat = 1e-14;

double largestComponent(const Vector& a)
{
  return std::max({ std::abs(a[0]), std::abs(a[1]), std::abs(a[2]) });
}

Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

} // namespace

bool isDegenerate(std::span<const std::int64_t> corners, std::span<const Vector> points)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (std::size_t k = i + 1; k < corners.size(); ++k)
    {
      if (corners[i] == corners[k])
      {
        return true;
      }
    }
  }
  std::array<Vector, 3> edges{};
  double longest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      edges[i - 1][axis] = points[i][axis] - points[0][axis];
    }
    longest = std::max(longest, largestComponent(edges[i - 1]));
  }
  if (longest == 0.0)
  {
    return true;
  }
  // Scaled, so that neither the tiny nor the enormous leave the range of a double.
  for (Vector& edge : edges)
  {
    for (double& component : edge)
    {
      component /= longest;
    }
  }
  const Vector normal = cross(edges[0], edges[1]);
  if (points.size() == 3)
  {
    return largestComponent(normal) <= Flat;
  }
  return std::abs(normal[0] * edges[2][0] + normal[1] * edges[2][1] + normal[2] * edges[2][2]) <=
         Flat;
}

} // namespace smg
