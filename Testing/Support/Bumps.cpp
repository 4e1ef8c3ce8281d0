// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/Bumps.h"

#include <Eigen/Geometry>

namespace smg::testing
{

IndexedTestMesh bumpy(const IndexedTestMesh& triangles, double amplitude, std::uint64_t seed)
{
  const Eigen::Map<const Eigen::Matrix3Xd> points(
    triangles.positions.data(), 3, triangles.vertices());
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, points.cols());
  double edges = 0.0;
  for (std::size_t c = 0; c < triangles.corners.size(); c += 3)
  {
    const std::int64_t* v = &triangles.corners[c];
    const Eigen::Vector3d first = points.col(v[1]) - points.col(v[0]);
    const Eigen::Vector3d second = points.col(v[2]) - points.col(v[0]);
    const Eigen::Vector3d normal = first.cross(second).normalized();
    edges += (first.norm() + second.norm() + (first - second).norm()) / 3.0;
    for (int k = 0; k < 3; ++k)
    {
      normals.col(v[k]) += normal;
    }
  }
  normals.colwise().normalize();
  const double height = amplitude * edges / static_cast<double>(triangles.cells());

  IndexedTestMesh result = triangles;
  Random random(seed);
  for (std::int64_t v = 0; v < triangles.vertices(); ++v)
  {
    Eigen::Vector3d::Map(&result.positions[3 * v]) +=
      height * random.uniform(-1.0, 1.0) * normals.col(v);
  }
  return result;
}

} // namespace smg::testing
