// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DeformationDescription.h"
#include "smg/Deform.h"
#include "smg/Error.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// Affine motions of handles: from parameters, or from a matrix by its polar decomposition. A motion
// keeps its rotation as a vector and its scale as a logarithm, which are what a deformation
// interpolates: a vector may have any length, so that angles beyond a half-turn keep their meaning.

namespace smg
{

DeformationDescription DeformationDescription::byColumns()
{
  DeformationDescription description;
  description.handles = { { ColumnMask{ HandleMaskName },
    HandleDescription::Values{ HandleTargetName, HandleRotationName, HandleLogScaleName } } };
  return description;
}

/** A tolerance replaces a number of V-cycles that the options may have: only one of them can end a
 * step. */
void DeformationDescription::applyTo(DeformOptions& options) const
{
  options.weights = this->weights.value_or(options.weights);
  if (this->cycles)
  {
    options.cycles = *this->cycles;
  }
  if (this->tolerance)
  {
    options.cycles = 0;
    options.tolerance = *this->tolerance;
  }
}

namespace
{

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

void requireFinite(std::span<const double> numbers, const char* what)
{
  if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
  {
    throw Error(std::string("The ") + what + " of a handle's motion must be finite.");
  }
}

/** The normalised vector. It is divided by its largest component first, since the squares of the
 * components may overflow or underflow. */
Eigen::Vector3d unit(const std::array<double, 3>& axis)
{
  const Eigen::Vector3d vector(axis[0], axis[1], axis[2]);
  const double largest = vector.cwiseAbs().maxCoeff();
  if (largest == 0.0)
  {
    throw Error("The axis of a handle's rotation must not be 0 0 0: it has no direction.");
  }
  return (vector / largest).normalized();
}

} // namespace

HandleMotion::HandleMotion(const Parameters& parameters)
  : Center(parameters.center)
  , Translation(parameters.translation)
{
  requireFinite(parameters.translation, "translation");
  requireFinite(parameters.axis, "rotation axis");
  requireFinite({ &parameters.degrees, 1 }, "rotation angle");
  requireFinite(parameters.center, "centre");
  requireFinite({ &parameters.scale, 1 }, "scale");
  if (!isScale(parameters.scale))
  {
    throw Error(std::string("The scale of a handle's motion ") + ScaleRule + '.');
  }
  if (!isAngle(parameters.degrees))
  {
    throw Error(std::string("The angle of a handle's rotation ") + DegreesRule + '.');
  }
  constexpr double Radian = std::numbers::pi / 180.0;
  const Eigen::Vector3d axis = unit(parameters.axis);
  // Full turns are subtracted for the matrix only, in degrees, where this is exact. The rotation
  // vector keeps them.
  const double turn = std::remainder(parameters.degrees, 360.0) * Radian;
  // Row by row, as apply() reads it.
  Eigen::Map<RowMajor>(this->Linear.data()) =
    parameters.scale * Eigen::AngleAxisd(turn, axis).toRotationMatrix();
  Eigen::Map<Eigen::Vector3d>(this->Rotation.data()) = parameters.degrees * Radian * axis;
  this->LogScale = std::log(parameters.scale);
}

/** The linear part is applied as it is; its nearest rotation and mean stretch are what the
 * deformation spreads over the mesh. */
HandleMotion HandleMotion::fromMatrix(std::span<const double, 16> matrix)
{
  requireFinite(matrix, "matrix");
  if (matrix[12] != 0.0 || matrix[13] != 0.0 || matrix[14] != 0.0 || matrix[15] != 1.0)
  {
    throw Error("The matrix of a handle's motion must be affine: its last row must be 0 0 0 1.");
  }
  HandleMotion motion;
  for (std::size_t row = 0; row < 3; ++row)
  {
    std::copy_n(matrix.data() + 4 * row, 3, motion.Linear.data() + 3 * row);
    motion.Translation[row] = matrix[4 * row + 3];
  }
  const Eigen::Matrix3d linear = Eigen::Map<const RowMajor>(motion.Linear.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d stretch = svd.singularValues();
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  // The determinant has the sign of the nearest orthogonal matrix, U V^T. That of a matrix which is
  // singular up to rounding has no meaningful sign.
  const bool flat = !(stretch[2] > 4.0 * std::numeric_limits<double>::epsilon() * stretch[0]);
  if (flat || nearest.determinant() < 0.0)
  {
    throw Error("The matrix of a handle's motion must have a positive determinant: it must neither "
                "flatten nor mirror.");
  }
  const Eigen::AngleAxisd turn(nearest);
  Eigen::Map<Eigen::Vector3d>(motion.Rotation.data()) = turn.angle() * turn.axis();
  // The cube root of the determinant, as the mean of logarithms, which does not overflow.
  motion.LogScale = stretch.array().log().sum() / 3.0;
  return motion;
}

bool HandleMotion::isIdentity() const
{
  // The centre of a motion without rotation and scale does not matter.
  const HandleMotion rest;
  return this->Linear == rest.Linear && this->Translation == rest.Translation &&
         this->Rotation == rest.Rotation && this->LogScale == rest.LogScale;
}

std::array<double, 3> HandleMotion::apply(std::span<const double, 3> point) const
{
  const std::array<double, 3> arm{ point[0] - this->Center[0], point[1] - this->Center[1],
    point[2] - this->Center[2] };
  std::array<double, 3> moved{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    const double* linear = this->Linear.data() + 3 * row;
    // What is added to the point is exactly 0 without rotation, scale and translation, so that
    // fixed vertices keep their bits.
    const double change = (linear[0] * arm[0] + linear[1] * arm[1] + linear[2] * arm[2]) - arm[row];
    moved[row] = point[row] + change + this->Translation[row];
  }
  return moved;
}

} // namespace smg
