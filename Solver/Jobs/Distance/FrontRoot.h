// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

namespace smg
{

/** The point that a vertex of a solid sees at the end of its straight part of the path: a source,
 * or a vertex at which the path turns. */
struct FrontRoot
{
  std::array<double, 3> point{};
  double offset = HUGE_VAL; ///< the distance of the point; infinite: it is not known

  bool isKnown() const { return this->offset < HUGE_VAL; }
  bool operator==(const FrontRoot&) const = default;
  /** The distance of a point that sees it. */
  double at(const double* p) const
  {
    const double x = p[0] - this->point[0], y = p[1] - this->point[1], z = p[2] - this->point[2];
    return this->offset + std::sqrt(x * x + y * y + z * z);
  }
};

} // namespace smg
