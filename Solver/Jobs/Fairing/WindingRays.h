// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * The winding numbers of closed surfaces around points: how often they enclose a point, by rays
 * from there in the direction of +x, on which triangles are counted one by one, in any order.
 *
 * Of a point of a surface where that is farthest in this direction, none of its own triangles
 * counts: the number is that just outside it, of the other ones.
 */
class SMG_EXPORT WindingRays
{
public:
  static constexpr std::int64_t RayBytes = 3 * sizeof(double) + sizeof(std::int64_t) + 4;

  /** Adds a point; returns its number. */
  std::size_t addPoint(const Vector& point);
  /** To be called after the last point. */
  void sort();
  /** Counts a triangle. */
  void count(const Vector& a, const Vector& b, const Vector& c);
  /** Of a point, of the triangles so far. */
  std::int64_t around(std::size_t point) const { return this->Windings[point]; }

private:
  std::vector<Vector> Points;
  std::vector<std::int64_t> Windings;
  std::vector<std::uint32_t> ByHeight; ///< the points in ascending order of z
};

} // namespace smg
