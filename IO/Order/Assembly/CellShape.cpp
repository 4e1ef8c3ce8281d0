// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/CellShape.h"

#include "Solver/Core/Vector.h"
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
  const auto edge = [&p](std::size_t k) { return difference(p[k].data(), p[0].data()); };
  return dot(edge(1), cross(edge(2), edge(3)));
}

} // namespace smg
