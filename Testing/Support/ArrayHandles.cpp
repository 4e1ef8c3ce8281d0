// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/ArrayHandles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smg::testing
{
namespace
{

using Positions = Eigen::Map<const Eigen::Matrix3Xd>;

Positions positionsOf(const StreamMesh& mesh)
{
  return { mesh.positions.data(), 3, mesh.vertices() };
}

/** The mean position of the vertices in the region. */
Eigen::Vector3d centerOf(const StreamMesh& mesh, const ArrayHandles::Region& region)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    if (region(positionsOf(mesh).col(v)))
    {
      sum += positionsOf(mesh).col(v);
      count += 1.0;
    }
  }
  return sum / std::max(count, 1.0);
}

} // namespace

Eigen::Matrix3d rotationMatrix(const Eigen::Vector3d& rotation)
{
  const double angle = rotation.norm();
  if (angle == 0.0)
  {
    return Eigen::Matrix3d::Identity();
  }
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

Eigen::Vector3d Motion::apply(const Eigen::Vector3d& point) const
{
  return this->center + this->scale * (rotationMatrix(this->rotation) * (point - this->center)) +
         this->translation;
}

Motion turn(double degrees, const Eigen::Vector3d& axis, const Eigen::Vector3d& center)
{
  Motion motion;
  motion.rotation = axis.normalized() * (degrees * std::numbers::pi / 180.0);
  motion.center = center;
  return motion;
}

Eigen::MatrixXd moved(const StreamMesh& mesh, const Motion& motion)
{
  Eigen::MatrixXd result(mesh.vertices(), 3);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    result.row(v) = motion.apply(positionsOf(mesh).col(v)).transpose();
  }
  return result;
}

void ArrayHandles::at(const MeshBlock& block, VertexHandles& handles)
{
  const auto copy = [&](const auto& from, auto& to, int components)
  { std::copy_n(from.begin() + components * block.firstVertex, to.size(), to.begin()); };
  copy(this->Values.mask, handles.mask, 1);
  copy(this->Values.target, handles.target, 3);
  copy(this->Values.rotation, handles.rotation, 3);
  copy(this->Values.logScale, handles.logScale, 1);
}

void ArrayHandles::hold(const StreamMesh& mesh, const Region& region, const Motion& motion)
{
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const Eigen::Vector3d point = positionsOf(mesh).col(v);
    if (region(point))
    {
      ++this->Values.mask[v];
      Eigen::Vector3d::Map(&this->Values.target[3 * v]) = motion.apply(point);
      Eigen::Vector3d::Map(&this->Values.rotation[3 * v]) = motion.rotation;
      this->Values.logScale[v] = std::log(motion.scale);
    }
  }
}

std::int64_t ArrayHandles::held() const
{
  return std::count_if(this->Values.mask.begin(), this->Values.mask.end(),
    [](std::uint8_t handles) { return handles > 0; });
}

ArrayHandles figureHandles(const StreamMesh& mesh, double degrees)
{
  const Positions positions = positionsOf(mesh);
  const Eigen::Vector3d low = positions.rowwise().minCoeff();
  const Eigen::Vector3d size = positions.rowwise().maxCoeff() - low;
  const auto fraction = [=](const Eigen::Vector3d& point, int axis)
  { return (point[axis] - low[axis]) / size[axis]; };
  const auto feet = [=](const Eigen::Vector3d& point) { return fraction(point, 1) < 0.06; };
  const auto top = [=](const Eigen::Vector3d& point) { return fraction(point, 1) > 0.92; };
  const auto arm = [=](const Eigen::Vector3d& point)
  { return fraction(point, 0) < 0.04 && !feet(point) && !top(point); };

  Motion topMotion = turn(degrees, { 1.0, 0.3, 0.0 }, centerOf(mesh, top));
  topMotion.scale = 1.3;
  topMotion.translation = size[1] * Eigen::Vector3d(0.0, 0.05, -0.25);
  Motion armMotion = turn(90.0, { 0.0, 0.2, 1.0 }, centerOf(mesh, arm));
  armMotion.translation = size[1] * Eigen::Vector3d(0.1, 0.2, 0.1);

  ArrayHandles handles(mesh.vertices());
  handles.hold(mesh, feet);
  handles.hold(mesh, top, topMotion);
  handles.hold(mesh, arm, armMotion);
  return handles;
}

} // namespace smg::testing
