// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/SurfaceBinding.h"

#include "Testing/Support/Isosurface.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// The laws of a surface that follows a coarser one: vertices of both are where the coarser ones
// are, a rigid motion is one of all vertices, and another one is followed about as well as the
// coarser surface follows it.

namespace smg::testing
{
namespace
{

using Motion = std::function<std::array<double, 3>(const double*)>;

/** A turn about an oblique axis, and a shift. */
std::array<double, 3> turn(const double* p)
{
  const double c = std::cos(2.0), s = std::sin(2.0);
  const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
  return { x + 5.0, c * y - s * p[2], s * y + c * p[2] - 3.0 };
}

/** Turns about the z axis, by a radian more for each unit of z. */
std::array<double, 3> twist(const double* p)
{
  const double c = std::cos(p[2]), s = std::sin(p[2]);
  return { c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] };
}

CoarserSurface coarser(const IndexedTestMesh& mesh, std::int64_t points)
{
  const std::vector<std::uint8_t> locked(static_cast<std::size_t>(mesh.vertices()), 0);
  return coarserSurface(mesh.positions, mesh.corners, locked, points);
}

/** The largest distance of the vertices from where a motion of the whole surface has them. */
double farthest(const IndexedTestMesh& mesh, const CoarserSurface& surface, const Motion& motion)
{
  std::vector<double> moved;
  for (const std::int64_t v : surface.vertices)
  {
    const std::array<double, 3> to = motion(mesh.positions.data() + 3 * v);
    moved.insert(moved.end(), to.begin(), to.end());
  }
  const SurfaceBinding binding(mesh.positions, mesh.corners, surface);
  const std::vector<double> places = binding.follow(moved);
  EXPECT_EQ(places.size(), mesh.positions.size());
  double far = 0.0;
  for (std::size_t i = 0; i < places.size(); i += 3)
  {
    const std::array<double, 3> to = motion(mesh.positions.data() + i);
    far =
      std::max(far, std::hypot(places[i] - to[0], places[i + 1] - to[1], places[i + 2] - to[2]));
  }
  for (std::size_t k = 0; k < surface.vertices.size(); ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t i = 3 * static_cast<std::size_t>(surface.vertices[k]) + axis;
      EXPECT_EQ(places[i], moved[3 * k + axis]);
    }
  }
  return far;
}

} // namespace

TEST(SurfaceBinding, FollowsRigidMotionsExactly)
{
  for (const IndexedTestMesh& mesh : { sphere(4), grid(40, 30, 0.2), noisyGyroid(20, 0.0) })
  {
    for (const std::int64_t points : { 40, 300 })
    {
      EXPECT_LT(farthest(mesh, coarser(mesh, points), turn), 1e-9) << points;
    }
  }
}

TEST(SurfaceBinding, FollowsATwistBetterTheMoreVerticesTheCoarserSurfaceHas)
{
  const IndexedTestMesh mesh = sphere(5);
  const double few = farthest(mesh, coarser(mesh, 100), twist);
  const double many = farthest(mesh, coarser(mesh, 1600), twist);
  EXPECT_LT(few, 0.1); // edges of about 0.4
  EXPECT_LT(many, few / 8.0);
}

TEST(SurfaceBinding, ThinTrianglesKeepAllInItsPlace)
{
  for (const double height : { 0.0, 1e-9, 1e-5 })
  {
    const std::vector<double> points{ 0, 0, 0, 1, 0, 0, 2, height, 0, 1.4, 0.1, 0.2 };
    const std::vector<std::int64_t> corners{ 0, 1, 2, 1, 2, 3 };
    const SurfaceBinding binding(points, corners, { { 0, 1, 2 }, { 0, 1, 2 } });
    std::vector<double> moved(points.begin(), points.begin() + 9);
    for (const double shift : { 0.0, 1000.0 })
    {
      for (std::size_t i = 0; i < moved.size(); i += 3)
      {
        moved[i] = points[i] + shift;
      }
      const std::vector<double> places = binding.follow(moved);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        EXPECT_NEAR(places[i], points[i] + (i % 3 == 0 ? shift : 0.0), 1e-11 * (1.0 + shift));
      }
    }
  }
}

TEST(SurfaceBinding, DoesNotFollowAnotherSheetNearby)
{
  const IndexedTestMesh sheet = grid(30, 30);
  const IndexedTestMesh both = disjointUnion(sheet, sheet, { 0.0, 0.0, 1e-3 });
  const Motion apart = [](const double* p) {
    return std::array<double, 3>{ p[0] + (p[2] > 5e-4 ? 1.0 : 0.0), p[1], p[2] };
  };
  EXPECT_LT(farthest(both, coarser(both, 60), apart), 1e-12);
}

TEST(SurfaceBinding, HeldVerticesAreAtTheirTargetsAndTakeTheirLooseBodiesAlong)
{
  const IndexedTestMesh large = sphere(4);
  const IndexedTestMesh one = disjointUnion(large, sphere(1), { 2.5, 0.0, 0.0 });
  const IndexedTestMesh mesh = disjointUnion(one, sphere(1), { -2.5, 0.0, 0.0 });
  const CoarserSurface surface = coarser(large, 200);
  std::vector<double> moved;
  for (const std::int64_t v : surface.vertices)
  {
    const double* p = mesh.positions.data() + 3 * v;
    moved.insert(moved.end(), { p[0] + 1.0, p[1], p[2] });
  }
  std::vector<std::uint8_t> held(static_cast<std::size_t>(mesh.vertices()), 0);
  std::vector<double> targets = mesh.positions;
  const auto first = static_cast<std::size_t>(large.vertices());
  const auto last = static_cast<std::size_t>(one.vertices());
  for (std::size_t v = first; v < last; v += 2)
  {
    held[v] = 1;
    targets[3 * v + 2] += 7.0;
  }
  const std::vector<double> places =
    SurfaceBinding(mesh.positions, mesh.corners, surface).follow(moved, held, targets);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const bool isLarge = i < 3 * first, isHeldBody = !isLarge && i < 3 * last;
    const double shift = isLarge ? (i % 3 == 0 ? 1.0 : 0.0) : isHeldBody && i % 3 == 2 ? 7.0 : 0.0;
    EXPECT_NEAR(places[i], mesh.positions[i] + shift, 1e-12);
  }
}

} // namespace smg::testing
