// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Testing/Solver/DistanceTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace smg::testing
{

/** The distance of a point from a triangle, by the nearest of its points. */
inline double fromTriangle(const StreamMesh& mesh, std::size_t firstCorner, const Vector& p)
{
  const auto point = [&](std::size_t k)
  { return &mesh.positions[3 * static_cast<std::size_t>(mesh.corners[firstCorner + k])]; };
  const Vector e = difference(point(1), point(0)), f = difference(point(2), point(0));
  const Vector to = difference(p.data(), point(0)), normal = cross(e, f);
  const double area = dot(normal, normal);
  double least = HUGE_VAL;
  if (area > 0)
  {
    const double x = dot(cross(to, f), normal) / area, y = dot(cross(e, to), normal) / area;
    if (x >= 0 && y >= 0 && x + y <= 1)
    {
      least = std::abs(dot(to, normal)) / std::sqrt(area);
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vector edge = difference(point((k + 1) % 3), point(k)),
                 on = difference(p.data(), point(k));
    const double share = std::clamp(dot(edge, on) / dot(edge, edge), 0.0, 1.0);
    const Vector foot = scaled(share, edge), rest = difference(on.data(), foot.data());
    least = std::min(least, std::sqrt(dot(rest, rest)));
  }
  return least;
}

/** Checks that all paths of a description are on the mesh and as long as the distance. */
inline void checkPaths(const StreamMesh& mesh, const Solved& solved)
{
  for (const Report::Path& path : solved.report.distance->paths)
  {
    const double distance = solved.values(path.to, 0);
    SCOPED_TRACE("to " + std::to_string(path.to));
    ASSERT_EQ(path.points.empty(), distance == HUGE_VAL) << distance;
    if (path.points.empty())
    {
      EXPECT_EQ(path.from, -1);
      continue;
    }
    // Vertices at one place are as far from each other as rounding makes them.
    constexpr double Rounding = 1e-15;
    EXPECT_NEAR(path.length, distance, 1e-9 * distance + Rounding);
    EXPECT_EQ(path.points.back(), (std::array{ mesh.positions[3 * std::size_t(path.to)],
                                    mesh.positions[3 * std::size_t(path.to) + 1],
                                    mesh.positions[3 * std::size_t(path.to) + 2] }));
    EXPECT_EQ(solved.values(path.from, 0), 0.0);
    double length = 0;
    for (std::size_t k = 1; k < path.points.size(); ++k)
    {
      const auto &a = path.points[k - 1], &b = path.points[k];
      const Vector part = difference(b.data(), a.data());
      length += std::sqrt(dot(part, part));
      const Vector middle{ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
      double off = HUGE_VAL;
      for (std::size_t c = 0; c < mesh.corners.size() && off > 1e-12; c += 3)
      {
        off = std::min(off, fromTriangle(mesh, c, middle));
      }
      EXPECT_LT(off, 1e-12) << "part " << k << " is not on the surface";
    }
    EXPECT_NEAR(length, path.length, 1e-12 * length + Rounding);
  }
}

} // namespace smg::testing
