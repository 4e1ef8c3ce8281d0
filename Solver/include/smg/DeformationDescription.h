// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"
#include "smg/ProblemDescription.h"
#include "smg/Region.h"

#include <array>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace smg
{

/**
 * The motion of a handle: p moves to M p + t. The rotation vector (unit axis times angle in
 * radians) and the logarithm of the scale are the boundary values for the mesh between the handles.
 */
class SMG_EXPORT HandleMotion
{
public:
  /** Rotation and scale about a centre, then translation. */
  struct Parameters
  {
    std::array<double, 3> translation{};
    std::array<double, 3> axis{ 0.0, 0.0, 1.0 }; ///< of any length except 0
    double degrees = 0.0; ///< from -MostDegrees to MostDegrees: 200 is not -160
    std::array<double, 3> center{};
    double scale = 1.0; ///< from LeastScale to MostScale
  };

  /** Beyond these limits, rounding destroys a mesh. */
  static constexpr double LeastScale = 1e-20, MostScale = 1e20, MostDegrees = 1e6;
  /** The error messages for a scale or an angle out of range. */
  static constexpr const char* ScaleRule = "must be greater than 0, between 1e-20 and 1e20";
  static constexpr const char* DegreesRule = "must be between -1e6 and 1e6 degrees";
  static constexpr bool isScale(double scale) { return scale >= LeastScale && scale <= MostScale; }
  static constexpr bool isAngle(double degrees)
  {
    return degrees >= -MostDegrees && degrees <= MostDegrees;
  }

  /** The identity. */
  HandleMotion() = default;
  /**
   * Throws Error if a number is not finite, the axis has no length, or the scale or the angle is
   * out of range.
   */
  explicit HandleMotion(const Parameters& parameters);
  /**
   * The motion of an affine matrix, row by row. The rotation is the one nearest to its linear part
   * (at most 180 degrees), the scale is the cube root of its determinant. Throws Error if a number
   * is not finite, the last row is not 0 0 0 1, or the determinant is not positive.
   */
  static HandleMotion fromMatrix(std::span<const double, 16> matrix);

  /** The target of the point. */
  std::array<double, 3> apply(std::span<const double, 3> point) const;
  const std::array<double, 3>& rotation() const { return this->Rotation; }
  double logScale() const { return this->LogScale; }
  /** Whether it moves no point and prescribes neither rotation nor scale. */
  bool isIdentity() const;

private:
  std::array<double, 9> Linear{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; // row by row
  /** apply(p) = p + (Linear - 1) (p - Center) + Translation; exactly p for the identity. */
  std::array<double, 3> Center{}, Translation{};
  std::array<double, 3> Rotation{};
  double LogScale = 0.0;
};

/** A handle: a part of a mesh and its motion. */
struct HandleDescription
{
  /** A motion vertex by vertex: values with the given numbers of components. */
  struct Values
  {
    DataValue target = Position{};          ///< 3: the target position
    DataValue rotation = { 0.0, 0.0, 0.0 }; ///< 3: the unit axis times the angle in radians
    DataValue logScale = 0.0;               ///< 1: the natural logarithm of the scale
  };

  /** A mask counts for as many handles as its value at the vertex, rounded up. */
  Where where;
  std::variant<HandleMotion, Values> motion;
};

/**
 * A deformation in terms of regions and columns of the mesh; DescribedHandles turns it into
 * Handles.
 *
 *     DeformationDescription turn;
 *     turn.handles = { { Region::Sphere{ { 0, 0, 0 }, 0.1 }, HandleMotion() }, // stays
 *       { ColumnTag{ "part", 3 }, HandleMotion({ .translation = { 0, 0, 1 } }) } };
 */
struct SMG_EXPORT DeformationDescription
{
  /** A vertex held by several handles follows the last one. */
  std::vector<HandleDescription> handles;
  /** Options of the deformation, if set; not both cycles and tolerance. */
  std::optional<Weights> weights;
  std::optional<int> cycles;
  std::optional<double> tolerance;

  /** The deformation by the handles in the vertex columns HandleMask, HandleTarget, HandleRotation
   * and HandleLogScale. */
  static DeformationDescription byColumns();

  /** Sets the options that are set here, and keeps the others. */
  void applyTo(DeformOptions& options) const;
};

} // namespace smg
