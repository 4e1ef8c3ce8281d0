// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/AxisEnds.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace smg
{

namespace
{

/** The share of the extent along an axis that counts as its end. */
constexpr double EndShare = 0.015;

Eigen::Vector3d point(std::span<const float> points, std::uint32_t i)
{
  const float* x = points.data() + std::size_t(3) * i;
  return { x[0], x[1], x[2] };
}

} // namespace

std::vector<std::vector<std::uint32_t>> axisEnds(
  std::span<const float> points, std::span<const std::uint32_t> chosen)
{
  std::vector<std::vector<std::uint32_t>> ends;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : chosen)
  {
    centre += point(points, i) / double(chosen.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen)
  {
    const Eigen::Vector3d x = point(points, i) - centre;
    covariance += x * x.transpose() / double(chosen.size());
  }
  if (!covariance.allFinite())
  {
    return ends; // a coordinate exceeded the range of float
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  for (const int axis : { 2, 1 })
  {
    const Eigen::Vector3d direction = axes.eigenvectors().col(axis);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const std::uint32_t i : chosen)
    {
      const double x = direction.dot(point(points, i) - centre);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (!(low < high))
    {
      break;
    }
    std::vector<std::uint32_t> lowEnd, highEnd;
    for (const std::uint32_t i : chosen)
    {
      const double x = (direction.dot(point(points, i) - centre) - low) / (high - low);
      if (x < EndShare)
      {
        lowEnd.push_back(i);
      }
      else if (x > 1 - EndShare)
      {
        highEnd.push_back(i);
      }
    }
    ends.push_back(std::move(lowEnd));
    ends.push_back(std::move(highEnd));
  }
  std::erase_if(ends, [](const std::vector<std::uint32_t>& end) { return end.size() < 2; });
  return ends;
}

} // namespace smg
