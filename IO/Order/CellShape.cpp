// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/CellShape.h"

#include "smg/CellWeights.h"

namespace smg
{

bool isDegenerate(
  std::span<const std::int64_t> corners, std::span<const std::array<double, 3>> points)
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
  const CellWeights weights =
    corners.size() == 3
      ? triangleWeights(points[0].data(), points[1].data(), points[2].data())
      : tetrahedronWeights(points[0].data(), points[1].data(), points[2].data(), points[3].data());
  return weights.measure == 0.0;
}

double orientedVolume(const std::array<std::array<double, 3>, 4>& p)
{
  std::array<double, 3> a{}, b{}, c{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    a[axis] = p[1][axis] - p[0][axis];
    b[axis] = p[2][axis] - p[0][axis];
    c[axis] = p[3][axis] - p[0][axis];
  }
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

} // namespace smg
