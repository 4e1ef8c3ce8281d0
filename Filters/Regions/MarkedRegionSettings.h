// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Region.h"

#include <optional>
#include <string>

namespace smg
{

/** The settings of a region that is defined by the mesh and its arrays: where an array has a value,
 * where it is not 0, or the boundary. */
struct MarkedRegionSettings
{
  std::string array;         ///< of points or cells, with one component; empty: the boundary
  std::optional<double> tag; ///< the value of the array; none: any value but 0
  int pieces = 0;            ///< in which the input is requested; 0: chosen

  bool operator==(const MarkedRegionSettings&) const = default;

  bool isBoundary() const { return this->array.empty(); }
  /** The region in terms of a problem. */
  Where where() const;
  /** Whether `value`, of an array of float if `isFloat`, is that of the region: a tag of 0.1 is
   * another number in single precision. Throws Error if it is not a number in a mask. */
  bool isMarked(double value, bool isFloat) const;
};

} // namespace smg
