// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/CellWeights.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace smg::testing
{
namespace
{

using Point = Eigen::Map<const Eigen::Vector3d>;

CellWeights triangleWeights(const Point& a, const Point& b, const Point& c)
{
  const double doubleArea = (b - a).cross(c - a).norm();
  CellWeights cell;
  cell.size = doubleArea / 2;
  // Half the cotangent of the angle opposite to each pair.
  cell.weight[0] = (a - c).dot(b - c) / doubleArea / 2;
  cell.weight[1] = (a - b).dot(c - b) / doubleArea / 2;
  cell.weight[2] = (b - a).dot(c - a) / doubleArea / 2;
  return cell;
}

CellWeights tetrahedronWeights(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const double sixVolumes = std::abs((b - a).dot((c - a).cross(d - a)));
  // The gradient of a corner's hat function is the opposite face's normal over six volumes; the
  // signs agree when the faces are all seen from outside.
  const Eigen::Vector3d gradients[4] = { (d - b).cross(c - b), (c - a).cross(d - a),
    (d - a).cross(b - a), (b - a).cross(c - a) };
  CellWeights cell;
  cell.size = sixVolumes / 6;
  for (int pair = 0; pair < 6; ++pair)
  {
    const auto [i, j] = TetrahedronPairs[pair];
    cell.weight[pair] = -gradients[i].dot(gradients[j]) / (6 * sixVolumes);
  }
  return cell;
}

} // namespace

CellWeights cellWeights(CellType type, const std::array<const double*, 4>& points)
{
  const CellWeights cell =
    type == CellType::Triangle
      ? triangleWeights(Point(points[0]), Point(points[1]), Point(points[2]))
      : tetrahedronWeights(Point(points[0]), Point(points[1]), Point(points[2]), Point(points[3]));
  for (const double weight : cell.weight)
  {
    if (!std::isfinite(weight))
    {
      return {};
    }
  }
  return cell;
}

} // namespace smg::testing
