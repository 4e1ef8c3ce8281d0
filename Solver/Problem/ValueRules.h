// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/MeshColumns.h"
#include "smg/Export.h"

#include <array>
#include <vector>

namespace smg
{

/** The admissible range of a datum, whose numbers and their squares must also be finite. */
enum class ValueRange
{
  Any,
  NotNegative,
  PositiveDefinite ///< a positive number, three (a diagonal), or a tensor of six
};

/** The admissible values of a datum. */
struct SMG_EXPORT ValueRules
{
  std::vector<int> components; ///< the admissible numbers of components
  ValueRange range = ValueRange::Any;
  bool positions = false;                        ///< whether it may be the position
  bool missing = false;                          ///< whether not a number (NaN) stands for no value
  ColumnOwner preferred = ColumnOwner::Vertices; ///< owner of the column if both have one

  /** The error of invalid numbers, for example "must be finite"; null if valid. */
  const char* complaint(const double* numbers, int count) const;
};

/**
 * The symmetric tensor xx, yy, zz, xy, yz, xz from one number, a diagonal, or all six components.
 */
std::array<double, 6> tensorOf(const double* numbers, int count);

} // namespace smg
