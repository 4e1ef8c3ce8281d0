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
 * How a handle moves the vertices that it holds: an affine map. Its rotation vector and the
 * logarithm of its scale are the values that the deformation spreads over the mesh between the
 * handles.
 */
class SMG_EXPORT HandleMotion
{
public:
  /** Rotation and scale about a centre, then translation. */
  struct Parameters
  {
    std::array<double, 3> translation{};         ///< in the unit of the mesh
    std::array<double, 3> axis{ 0.0, 0.0, 1.0 }; ///< of rotation; any length but 0
    /** Angle, from -MaxDegrees to MaxDegrees. It may exceed a half-turn: 200 is not -160. */
    double degrees = 0.0;
    std::array<double, 3> center{}; ///< of rotation and scale, in the unit of the mesh
    double scale = 1.0;             ///< factor, from MinScale to MaxScale
  };

  /** Smallest scale. Beyond this limit, and the next two, rounding leaves nothing of a mesh. */
  static constexpr double MinScale = 1e-20;
  /** Largest scale. */
  static constexpr double MaxScale = 1e20;
  /** Largest magnitude of an angle, degrees. */
  static constexpr double MaxDegrees = 1e6;
  /** The text of errors for a scale that is out of range. */
  static constexpr const char* ScaleRule = "must be greater than 0, between 1e-20 and 1e20";
  /** The text of errors for an angle that is out of range. */
  static constexpr const char* DegreesRule = "must be between -1e6 and 1e6 degrees";
  /** Whether a scale is from MinScale to MaxScale. */
  static constexpr bool isScale(double scale) { return scale >= MinScale && scale <= MaxScale; }
  /** Whether an angle is from -MaxDegrees to MaxDegrees. */
  static constexpr bool isAngle(double degrees)
  {
    return degrees >= -MaxDegrees && degrees <= MaxDegrees;
  }

  /** The identity: every vertex stays where it is. */
  HandleMotion() = default;
  /**
   * Rotation and scale about a centre, then translation.
   * @throws Error if a number is not finite, the axis has the length 0, or the scale or the angle
   * is out of range
   */
  explicit HandleMotion(const Parameters& parameters);
  /**
   * The motion of an affine 4 x 4 matrix, given row by row. Its rotation, of at most 180 degrees,
   * is the one nearest to the linear part; its scale is the cube root of the determinant.
   * @throws Error if a number is not finite, the last row is not 0 0 0 1, or the determinant is not
   * positive
   */
  static HandleMotion fromMatrix(std::span<const double, 16> matrix);

  /** The position (x, y, z) that the map gives to `point`. */
  std::array<double, 3> apply(std::span<const double, 3> point) const;
  /** Rotation vector: the unit axis times the angle in radians. */
  const std::array<double, 3>& rotation() const { return this->Rotation; }
  /** Natural logarithm of the scale. */
  double logScale() const { return this->LogScale; }
  /** Whether the map, the rotation and the scale are exactly the identity. */
  bool isIdentity() const;

private:
  std::array<double, 9> Linear{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; // row by row
  /** apply(p) = p + (Linear - 1) (p - Center) + Translation; exactly p where nothing moves. */
  std::array<double, 3> Center{}, Translation{};
  std::array<double, 3> Rotation{};
  double LogScale = 0.0;
};

/** A handle: a part of a mesh that it holds, and the motion of that part. */
struct HandleDescription
{
  /** A motion given vertex by vertex, as numbers or by columns of the mesh. */
  struct Values
  {
    DataValue target = Position{};          ///< 3 numbers: the new position
    DataValue rotation = { 0.0, 0.0, 0.0 }; ///< 3 numbers: the unit axis times the angle in radians
    DataValue logScale = 0.0;               ///< 1 number: the natural logarithm of the scale
    /** Of NearestVertices, instead of `target`: the new position (x, y, z) of the vertex of each of
     * its points. A vertex that is nearest to several points follows the last one. Empty: `target`
     * holds. */
    std::vector<std::array<double, 3>> targets = {};
  };

  /** The vertices that are held. A selected vertex of a ColumnMask counts as held by as many
   * handles as the value of the mask says, rounded up. */
  Where where;
  std::variant<HandleMotion, Values> motion; ///< the motion of these vertices
};

/**
 * A deformation in terms of regions and columns of a mesh. DescribedHandles makes Handles of it.
 *
 *     DeformationDescription turn;
 *     turn.handles = { { Region::Sphere{ { 0, 0, 0 }, 0.1 }, HandleMotion() }, // stays
 *       { ColumnTag{ "part", 3 }, HandleMotion({ .translation = { 0, 0, 1 } }) } };
 */
struct SMG_EXPORT DeformationDescription
{
  /** The handles. A vertex held by several of them follows the last one. */
  std::vector<HandleDescription> handles;
  std::optional<Weights> weights;  ///< DeformOptions::weights, if given
  std::optional<int> cycles;       ///< DeformOptions::cycles, if given; not with `tolerance`
  std::optional<double> tolerance; ///< SolveOptions::tolerance, if given; not with `cycles`

  /** One handle, given by the vertex columns HandleMask, HandleTarget, HandleRotation and
   * HandleLogScale (see VertexHandles, Deform.h). */
  static DeformationDescription byColumns();

  /** Sets the options that are given and leaves the others; a tolerance sets `cycles` to 0. */
  void applyTo(DeformOptions& options) const;
};

/**
 * Deforms a stored mesh by the handles of a description, as DescribedHandles and the other deform()
 * do.
 * @param mesh the mesh, read once, and once more if the description selects parts of it
 * @param description the handles; what it says of weights, cycles and tolerance goes before options
 * @param options how to solve; the text of a checkpoint for the mesh is set if it is empty
 * @param name what error messages call the description, for instance its file
 * @return as the other deform()
 * @throws Error as the other deform(), and if the description does not fit the mesh
 */
SMG_EXPORT std::unique_ptr<Solution> deform(const StoredMesh& mesh,
  const DeformationDescription& description, const DeformOptions& options = {},
  const std::string& name = "deformation");

} // namespace smg
