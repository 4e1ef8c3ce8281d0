// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Finds points of the plane in a triangle: points are sorted into horizontal strips, as many as the
 * square root of their number, and by x in each. A triangle that is as long as all of them, but
 * thin, is then compared with about a strip's number of points.
 */
class PointStrips
{
public:
  using Point = std::array<double, 2>;

  /** Sorts the points with these numbers. The points must outlive this object. */
  void build(std::span<const Point> points, std::vector<std::uint32_t> numbers)
  {
    this->Points = points;
    this->Numbers = std::move(numbers);
    const auto ofY = [&points](std::uint32_t k) { return points[k][1]; };
    const auto [low, high] = std::ranges::minmax(this->Numbers, {}, ofY);
    this->Count = static_cast<std::size_t>(std::sqrt(double(this->Numbers.size())));
    this->Low = ofY(low);
    this->Height = (ofY(high) - this->Low) / double(this->Count);
    std::ranges::sort(this->Numbers, {},
      [&](std::uint32_t k) { return std::pair(this->stripOf(points[k][1]), points[k][0]); });
    this->Begins.assign(this->Count + 1, 0);
    for (const std::uint32_t k : this->Numbers)
    {
      ++this->Begins[this->stripOf(points[k][1]) + 1];
    }
    for (std::size_t strip = 0; strip < this->Count; ++strip)
    {
      this->Begins[strip + 1] += this->Begins[strip];
    }
  }

  /** The number of points. */
  std::size_t size() const { return this->Numbers.size(); }

  using Triangle = std::array<Point, 3>;

  /** Whether `isFound` is true for the number of a point: it is called for all within `reach` of
   * the triangle, and for others near it, until it is true. */
  template <class IsFound>
  bool anyOf(const Triangle& triangle, double reach, IsFound&& isFound) const
  {
    const auto [low, high] = std::minmax({ triangle[0][1], triangle[1][1], triangle[2][1] });
    reach += Margin * this->Height;
    const std::size_t last = this->stripOf(high + reach);
    for (std::size_t strip = this->stripOf(low - reach); strip <= last; ++strip)
    {
      const auto [left, right] = this->across(triangle, reach, strip);
      const auto end = this->Numbers.begin() + this->Begins[strip + 1];
      auto at = std::lower_bound(this->Numbers.begin() + this->Begins[strip], end, left,
        [this](std::uint32_t k, double x) { return this->Points[k][0] < x; });
      for (; at != end && this->Points[*at][0] <= right; ++at)
      {
        if (isFound(*at))
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  /** By which triangles are taken larger than they are, relative to the height of a strip. */
  static constexpr double Margin = 1e-6;

  std::size_t stripOf(double y) const
  {
    const double strip = this->Height > 0.0 ? (y - this->Low) / this->Height : 0.0;
    return std::min(static_cast<std::size_t>(std::max(strip, 0.0)), this->Count - 1);
  }

  /** The least and the largest x of what is within `reach` of a triangle in a strip, or somewhat
   * more. */
  std::array<double, 2> across(const Triangle& triangle, double reach, std::size_t strip) const
  {
    const double low = this->Low + double(strip) * this->Height - reach;
    const double high = low + this->Height + 2 * reach;
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (std::size_t side = 0; side < 3; ++side)
    {
      const Point& p = triangle[side];
      const Point& q = triangle[(side + 1) % 3];
      const double rise = q[1] - p[1];
      const auto [first, second] = std::minmax(p[1], q[1]);
      if (second < low || first > high)
      {
        continue;
      }
      for (const Point& end : { p, q })
      {
        // An almost level side is taken whole.
        const double y = std::clamp(end[1], low, high);
        const double x = std::abs(rise) > reach ? p[0] + (y - p[1]) / rise * (q[0] - p[0]) : end[0];
        left = std::min(left, x);
        right = std::max(right, x);
      }
    }
    const double more = 1e-9 * (right - left) + 2 * reach;
    return { left - more, right + more };
  }

  std::span<const Point> Points;
  std::vector<std::uint32_t> Numbers; ///< by strip, then by x
  std::vector<std::ptrdiff_t> Begins; ///< of the strips, and the end
  std::size_t Count = 1;
  double Low = 0.0, Height = 0.0; ///< the least y; of a strip
};

} // namespace smg
