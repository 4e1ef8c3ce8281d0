// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace smg::testing
{

/** A simple polygon in space. */
struct RandomPolygon
{
  std::vector<double> corners; ///< x, y, z of each
  double area = 0.0;

  std::size_t size() const { return this->corners.size() / 3; }
};

namespace randompolygon
{

using Point = std::array<double, 2>;

inline double twiceArea(const Point& a, const Point& b, const Point& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** Random points, with integer coordinates below `grid` unless that is 0, joined along a closed way
 * whose crossings are removed by turning parts around. */
inline std::vector<Point> uncrossed(Random& random, int count, int grid = 0)
{
  std::vector<Point> way(static_cast<std::size_t>(count));
  for (Point& point : way)
  {
    point = grid > 0 ? Point{ double(random.below(grid)), double(random.below(grid)) }
                     : Point{ random.uniform(), random.uniform() };
  }
  const auto cross = [&way](std::size_t i, std::size_t j)
  {
    const Point &a = way[i], &b = way[i + 1], &c = way[j], &d = way[(j + 1) % way.size()];
    return twiceArea(a, b, c) * twiceArea(a, b, d) < 0 &&
           twiceArea(c, d, a) * twiceArea(c, d, b) < 0;
  };
  for (bool isCrossed = true; isCrossed;)
  {
    isCrossed = false;
    for (std::size_t i = 0; i + 2 < way.size(); ++i)
    {
      for (std::size_t j = i + 2; j < way.size(); ++j)
      {
        if (cross(i, j))
        {
          std::reverse(way.begin() + std::ptrdiff_t(i) + 1, way.begin() + std::ptrdiff_t(j) + 1);
          isCrossed = true;
        }
      }
    }
  }
  return way;
}

/** A star with arms of any length. */
inline std::vector<Point> star(Random& random, int count)
{
  std::vector<Point> corners;
  for (int k = 0; k < count; ++k)
  {
    const double angle = 2 * std::numbers::pi * (k + random.uniform(0.0, 0.9)) / count;
    const double radius = std::pow(10.0, random.uniform(-2.0, 0.0));
    corners.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  return corners;
}

/** A comb with teeth, whose sides have corners between their ends. */
inline std::vector<Point> comb(int teeth)
{
  std::vector<Point> corners;
  for (int k = 0; k < teeth; ++k)
  {
    corners.insert(corners.end(), { { 4.0 * k, 1.0 }, { 4.0 * k, 3.0 }, { 4.0 * k, 9.0 },
                                    { 4.0 * k + 2, 9.0 }, { 4.0 * k + 2, 1.0 } });
  }
  corners.insert(corners.end(), { { 4.0 * teeth, 1.0 }, { 4.0 * teeth, 0.0 }, { 0.0, 0.0 } });
  return corners;
}

/** A square with a hole, which two sides at the same place join to the outline. */
inline std::vector<Point> frame()
{
  return { { 0, 0 }, { 6, 0 }, { 6, 6 }, { 0, 6 }, { 0, 0 }, { 2, 2 }, { 2, 4 }, { 4, 4 }, { 4, 2 },
    { 2, 2 } };
}

/** A simple polygon of integer coordinates, of which many lie on lines through others. */
inline std::vector<Point> ofGrid(Random& random, int count)
{
  for (;;)
  {
    std::vector<Point> corners = uncrossed(random, count, 4);
    bool isSimple = true;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
      for (std::size_t k = 0; k < corners.size() && isSimple; ++k)
      {
        const Point& p = corners[k];
        const double along = (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]);
        isSimple = k == i || k == (i + 1) % corners.size() || twiceArea(a, b, p) != 0 || along > 0;
      }
    }
    if (isSimple)
    {
      return corners;
    }
  }
}

} // namespace randompolygon

/** A polygon of one of several kinds, in any place and plane, with any first corner and either
 * orientation. `kind` is at least 0. */
inline RandomPolygon randomPolygon(Random& random, int kind)
{
  using namespace randompolygon;
  const auto between = [&random](int least, int most)
  { return least + static_cast<int>(random.below(most - least + 1)); };
  std::vector<Point> flat = kind % 5 == 0   ? uncrossed(random, between(4, 14))
                            : kind % 5 == 1 ? star(random, between(4, 40))
                            : kind % 5 == 2 ? comb(between(1, 9))
                            : kind % 5 == 3 ? ofGrid(random, between(4, 8))
                                            : frame();
  RandomPolygon polygon;
  for (std::size_t k = 1; k + 1 < flat.size(); ++k)
  {
    polygon.area += twiceArea(flat[0], flat[k], flat[k + 1]) / 2;
  }
  polygon.area = std::abs(polygon.area);
  std::rotate(flat.begin(), flat.begin() + random.below(std::int64_t(flat.size())), flat.end());
  if (random.below(2) == 1)
  {
    std::reverse(flat.begin(), flat.end());
  }
  // Two axes of a random frame: a quaternion.
  std::array<double, 4> q{};
  for (double& part : q)
  {
    part = random.uniform(-1.0, 1.0);
  }
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const std::array<double, 3> u{ 1 - 2 * (q[2] * q[2] + q[3] * q[3]) / square,
    2 * (q[1] * q[2] + q[0] * q[3]) / square, 2 * (q[1] * q[3] - q[0] * q[2]) / square };
  const std::array<double, 3> v{ 2 * (q[1] * q[2] - q[0] * q[3]) / square,
    1 - 2 * (q[1] * q[1] + q[3] * q[3]) / square, 2 * (q[2] * q[3] + q[0] * q[1]) / square };
  const double far = random.uniform(-100.0, 100.0);
  for (const Point& corner : flat)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      polygon.corners.push_back(far + corner[0] * u[axis] + corner[1] * v[axis]);
    }
  }
  return polygon;
}

} // namespace smg::testing
