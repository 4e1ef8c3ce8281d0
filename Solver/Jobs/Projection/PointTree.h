// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/** A k-d tree of points: finds the nearest one in logarithmic time. */
class PointTree
{
public:
  struct Nearest
  {
    std::int64_t point = -1; ///< its index; -1: none within the limit
    double squaredDistance = std::numeric_limits<double>::infinity();
    std::int64_t compared = 0; ///< number of compared points
  };

  PointTree() = default;
  /** `positions`: x, y, z of each point, all finite. */
  explicit PointTree(std::span<const double> positions);

  /** The point nearest to `place` among those whose squared distance is at most `limit`; of several
   * equally near ones, that with the lowest index. */
  Nearest nearest(
    std::span<const double, 3> place, double limit = std::numeric_limits<double>::infinity()) const;

  /** The squared distance as computed by nearest(). */
  static double squaredDistance(std::span<const double, 3> a, std::span<const double, 3> b)
  {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
  }

private:
  struct Point
  {
    std::array<double, 3> position;
    std::int64_t number;
  };

  void build(std::size_t begin, std::size_t end);
  void search(
    std::size_t begin, std::size_t end, std::span<const double, 3> place, Nearest& found) const;

  /** Every range that is not a leaf has its median in the middle, and smaller points on the left.
   */
  std::vector<Point> Points;
  std::vector<std::uint8_t> Axes; ///< the split axis of the range whose middle is here
};

} // namespace smg
