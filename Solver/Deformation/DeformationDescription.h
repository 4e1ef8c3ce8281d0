// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/DeformOptions.h"
#include "Solver/Deformation/HandleMotion.h"
#include "Solver/Deformation/Handles.h"
#include "Solver/Description/Datum.h"
#include "Solver/Engine/Solution.h"

#include <optional>
#include <variant>
#include <vector>

namespace smg
{

/** What holds a part of a mesh, and where that goes. */
struct HandleDescription
{
  /** Said vertex by vertex: of each a value of so many numbers. */
  struct Values
  {
    DataValue target = Position{};          ///< 3: where it goes
    DataValue rotation = { 0.0, 0.0, 0.0 }; ///< 3: the unit axis times the angle in radians
    DataValue logScale = 0.0;               ///< 1: the natural logarithm of the scale
  };

  /** A mask counts, where it selects, for as many handles as its value says, rounded up. */
  Where where;
  std::variant<HandleMotion, Values> motion;
};

/**
 * How a mesh is deformed, in terms of regions and columns of that mesh; DescribedHandles makes it
 * Handles.
 *
 *     DeformationDescription turn;
 *     turn.handles = { { Region::Sphere{ { 0, 0, 0 }, 0.1 }, HandleMotion() }, // stays
 *       { ColumnTag{ "part", 3 }, HandleMotion({ .translation = { 0, 0, 1 } }) } };
 */
struct DeformationDescription
{
  /** A vertex that several hold follows the last one. */
  std::vector<HandleDescription> handles;
  /** How to deform, where it is said; not both of cycles and tolerance. */
  std::optional<Weights> weights;
  std::optional<int> cycles;
  std::optional<double> tolerance;

  /** By the handles that stand in the vertex columns HandleMask, HandleTarget, HandleRotation and
   * HandleLogScale. */
  static DeformationDescription byColumns();

  /** Sets the options that are said, and leaves the others. */
  void applyTo(DeformOptions& options) const;
};

} // namespace smg
