// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace smg
{

/** The settings of a region that is defined by single points. */
struct PointRegionSettings
{
  enum class Kind
  {
    Selection,
    Ids,
    Points
  };

  Kind kind = Kind::Selection;
  std::vector<std::int64_t> ids;
  bool areOriginalIds = false; ///< else GlobalIds
  std::vector<double> points;  ///< x, y, z of each
  double radius = -1.0;        ///< negative: chosen to suit the points
  int rings = 0;
  int pieces = 0; ///< in which the input is requested; 0: chosen

  bool operator==(const PointRegionSettings&) const = default;

  /** Whether only the points themselves are held. */
  bool isAlone() const { return this->radius <= 0.0 && this->rings == 0; }
  bool isSoughtById() const { return this->kind == Kind::Ids && this->isAlone(); }

  /** Throws Error if settings that the kind needs are missing or invalid. */
  void check(bool hasSelection) const;
};

} // namespace smg
