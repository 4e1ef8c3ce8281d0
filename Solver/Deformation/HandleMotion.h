// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

namespace smg
{

/**
 * How a handle moves what it holds: p goes to M p + t. The rotation vector (unit axis times angle
 * in radians) and the logarithm of the scale are what the handle tells the mesh between the
 * handles.
 */
class HandleMotion
{
public:
  /** Rotation and scale about a centre, then translation. */
  struct Parameters
  {
    std::array<double, 3> translation{};
    std::array<double, 3> axis{ 0.0, 0.0, 1.0 }; ///< of any length but 0
    double degrees = 0.0; ///< from -MostDegrees to MostDegrees: 200 turns the long way round
    std::array<double, 3> center{};
    double scale = 1.0; ///< from LeastScale to MostScale
  };

  /** Beyond these, rounding leaves nothing of a mesh. */
  static constexpr double LeastScale = 1e-20, MostScale = 1e20, MostDegrees = 1e6;
  /** What errors say of a scale or an angle that is out of range. */
  static constexpr const char* ScaleRule = "must be greater than 0, between 1e-20 and 1e20";
  static constexpr const char* DegreesRule = "must be between -1e6 and 1e6 degrees";
  static constexpr bool isScale(double scale) { return scale >= LeastScale && scale <= MostScale; }
  static constexpr bool isAngle(double degrees)
  {
    return degrees >= -MostDegrees && degrees <= MostDegrees;
  }

  /** Everything stays where it is. */
  HandleMotion() = default;
  /**
   * Throws Error if a number is not finite, the axis has no length, or the scale or the angle is
   * out of range.
   */
  explicit HandleMotion(const Parameters& parameters);
  /**
   * The motion of an affine matrix, row by row. What turns is the rotation nearest to its linear
   * part (at most 180 degrees), the scale is the cube root of its determinant. Throws Error if a
   * number is not finite, the last row is not 0 0 0 1, or the determinant is not positive.
   */
  static HandleMotion fromMatrix(std::span<const double, 16> matrix);

  /** Where the point goes. */
  std::array<double, 3> apply(std::span<const double, 3> point) const;
  const std::array<double, 3>& rotation() const { return this->Rotation; }
  double logScale() const { return this->LogScale; }
  /** Whether it moves no point and tells the mesh between the handles not to turn or grow. */
  bool isIdentity() const;

private:
  std::array<double, 9> Linear{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; // row by row
  /** apply(p) = p + (Linear - 1) (p - Center) + Translation; exactly p where nothing moves. */
  std::array<double, 3> Center{}, Translation{};
  std::array<double, 3> Rotation{};
  double LogScale = 0.0;
};

} // namespace smg
