// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/MeshColumns.h"
#include "smg/Export.h"

#include <array>
#include <vector>

namespace smg
{

/** What numbers a datum may have, beside that they are finite, and their squares, too. */
enum class ValueRange
{
  Any,
  NotNegative,
  PositiveDefinite ///< a positive number, three (a diagonal), or a tensor of six
};

/** What values a datum may have. */
struct SMG_EXPORT ValueRules
{
  std::vector<int> components; ///< the numbers of numbers that it may have
  ValueRange range = ValueRange::Any;
  bool positions = false;                        ///< whether it may be the position
  ColumnOwner preferred = ColumnOwner::Vertices; ///< whose column a name means if both have one

  /** What is wrong with such numbers, as "must be finite"; null: nothing. */
  const char* complaint(const double* numbers, int count) const;
};

/** A symmetric tensor xx, yy, zz, xy, yz, xz of one number, a diagonal, or its own six numbers. */
std::array<double, 6> tensorOf(const double* numbers, int count);

} // namespace smg
