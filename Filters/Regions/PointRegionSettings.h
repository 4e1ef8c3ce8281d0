// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace smg
{

/** What says which points of a mesh are held by a region that single points make. */
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
  double radius = -1.0;        ///< below 0: what suits the points
  int rings = 0;
  int pieces = 64; ///< how many pieces the input is pulled in

  bool operator==(const PointRegionSettings&) const = default;

  /** Whether nothing around the points is held with them. */
  bool isAlone() const { return this->radius <= 0.0 && this->rings == 0; }
  bool isSoughtById() const { return this->kind == Kind::Ids && this->isAlone(); }

  /** Throws Error if what the kind needs is missing or wrong. */
  void check(bool hasSelection) const;
};

} // namespace smg
