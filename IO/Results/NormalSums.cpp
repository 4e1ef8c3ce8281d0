// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/NormalSums.h"

#include <cmath>

namespace smg
{
namespace
{

TriangleShape shapeOf(const TriangleView& triangles, std::size_t cell)
{
  const auto point = [&](std::size_t k)
  {
    const auto vertex = static_cast<std::size_t>(triangles.corners[3 * cell + k]);
    return triangles.positions.subspan(3 * vertex).first<3>();
  };
  return shapeOfTriangle(point(0), point(1), point(2));
}

} // namespace

std::array<float, 3> unitNormal(std::span<const double, 3> sum)
{
  const double size = std::hypot(sum[0], sum[1], sum[2]);
  std::array<float, 3> normal{};
  for (std::size_t axis = 0; axis < 3 && size > 0.0; ++axis)
  {
    normal[axis] = static_cast<float>(sum[axis] / size);
  }
  return normal;
}

std::vector<double> normalSums(const TriangleView& triangles)
{
  std::vector<double> sums(triangles.positions.size());
  for (std::size_t cell = 0; cell < triangles.corners.size() / 3; ++cell)
  {
    if (!triangles.flags.empty() && triangles.flags[cell] != 0)
    {
      continue;
    }
    const TriangleShape shape = shapeOf(triangles, cell);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto vertex = static_cast<std::size_t>(triangles.corners[3 * cell + k]);
      addNormal(shape, k, std::span(sums).subspan(3 * vertex).first<3>());
    }
  }
  return sums;
}

std::vector<float> unitNormals(std::span<const double> sums)
{
  std::vector<float> normals;
  normals.reserve(sums.size());
  for (std::size_t k = 0; k < sums.size(); k += 3)
  {
    const std::array<float, 3> normal = unitNormal(sums.subspan(k).first<3>());
    normals.insert(normals.end(), normal.begin(), normal.end());
  }
  return normals;
}

std::vector<float> normalsOf(const TriangleView& triangles)
{
  std::vector<float> normals;
  normals.reserve(triangles.corners.size());
  for (std::size_t cell = 0; cell < triangles.corners.size() / 3; ++cell)
  {
    for (const double number : shapeOf(triangles, cell).normal)
    {
      normals.push_back(static_cast<float>(number));
    }
  }
  return normals;
}

} // namespace smg
