// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Deform.h"

#include <Eigen/Core>

#include <functional>

namespace smg::testing
{

/** The motion of a handle: p moves to center + scale R (p - center) + translation, R =
 * exp(rotation). Independent of HandleMotion, which is under test itself. */
struct Motion
{
  Eigen::Vector3d rotation =
    Eigen::Vector3d::Zero(); ///< unit axis times angle in radians, unbounded
  double scale = 1.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
};

/** A rotation about an axis of any length. */
Motion turn(double degrees, const Eigen::Vector3d& axis,
  const Eigen::Vector3d& center = Eigen::Vector3d::Zero());

/** exp of a rotation vector. */
Eigen::Matrix3d rotationMatrix(const Eigen::Vector3d& rotation);

/** The positions of all vertices after a motion, one row per vertex. */
Eigen::MatrixXd moved(const StreamMesh& mesh, const Motion& motion);

/** Handles from arrays of all vertices in stream order. */
class ArrayHandles : public Handles
{
public:
  using Region = std::function<bool(const Eigen::Vector3d&)>;

  /** Creates handles without held vertices. */
  explicit ArrayHandles(std::int64_t vertices) { this->Values.clear(vertices); }

  void at(const MeshBlock& block, VertexHandles& handles) override;

  /** Holds the vertices in the region with this motion, which replaces earlier handles. */
  void hold(const StreamMesh& mesh, const Region& region, const Motion& motion = {});

  std::int64_t held() const;

  VertexHandles Values;
};

/**
 * Handles of an upright figure, in fractions of its bounds: the lowest 6 % of y (feet) are fixed;
 * the highest 8 % (top) are rotated by `degrees` (70), scaled by 1.3 and moved; of the rest the
 * first 4 % of x (an arm) are rotated by 90 degrees and moved.
 */
ArrayHandles figureHandles(const StreamMesh& mesh, double degrees = 70.0);

} // namespace smg::testing
