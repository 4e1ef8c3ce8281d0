// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"

#include "smg/Region.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

// Exact distances where rounding decides which of two paths is the shorter one: straight paths
// through vertices, fronts side by side, and any frame of coordinates.

namespace smg::testing
{
namespace
{

/** A regular grid, folded at random along its rows and rounded to single precision: its straight
 * paths pass through vertices, around which the angles are a full turn but for rounding. */
KnownSurface foldedStrip(Random& random)
{
  const int columns = 4 + static_cast<int>(random.below(26));
  const int rows = 4 + static_cast<int>(random.below(26));
  const double most = random.below(2) == 0 ? 0.1 : 1.2;
  const Eigen::Matrix3d frame = Eigen::Quaterniond(
    random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
                                  .normalized()
                                  .toRotationMatrix();
  IndexedTestMesh mesh;
  std::vector<std::array<double, 2>> flat;
  Eigen::Vector3d place(0, 0, 0);
  for (int i = 0; i <= columns; ++i)
  {
    for (int j = 0; j <= rows; ++j)
    {
      flat.push_back({ double(i) / columns, double(j) / rows });
      const Eigen::Vector3d p = frame * (place + Eigen::Vector3d(0, double(j) / rows, 0));
      for (const double x : p)
      {
        mesh.positions.push_back(static_cast<double>(static_cast<float>(x)));
      }
      if (i < columns && j < rows)
      {
        const std::int64_t a = i * (rows + 1) + j, b = a + 1, c = a + rows + 1, d = c + 1;
        mesh.corners.insert(mesh.corners.end(), { a, c, d, a, d, b });
      }
    }
    const double angle = random.uniform(-most, most);
    place += Eigen::Vector3d(std::cos(angle), 0, std::sin(angle)) / columns;
  }
  return unfolding("strip", mesh, flat, straight);
}

TEST(DistanceRounding, ExactOnesAreRightOnFoldedStripsInSinglePrecision)
{
  Random random(29);
  for (int run = 0; run < 250; ++run)
  {
    const KnownSurface surface = foldedStrip(random);
    const MemoryMesh mesh(surface.mesh);
    const std::int64_t a = random.below(surface.mesh.vertices());
    const Eigen::MatrixXd from = measure(mesh, fromPoints({ a }, PathAccuracy::Exact)).values;
    double worst = 0;
    std::int64_t b = 0;
    for (std::int64_t v = 0; v < surface.mesh.vertices(); ++v)
    {
      const double error = from(v, 0) - surface.exact(a, v);
      b = std::abs(error) > worst ? v : b;
      worst = std::max(worst, std::abs(error));
    }
    EXPECT_LT(worst, 2e-6) << "run " << run << " from " << a << " to " << b; // of the rounding
    const double back = measure(mesh, fromPoints({ b }, PathAccuracy::Exact)).values(a, 0);
    EXPECT_NEAR(from(b, 0), back, 1e-10);
  }
}

TEST(DistanceRounding, ExactOnesOfARegionDoNotDependOnTheFrame)
{
  Random random(31);
  for (int run = 0; run < 150; ++run)
  {
    const double stretch = std::pow(10.0, random.uniform(0, 3));
    IndexedTestMesh flat = unitSquare(3 + static_cast<int>(random.below(12)), 0.45);
    for (std::size_t k = 0; k < flat.positions.size(); k += 3)
    {
      flat.positions[k] *= stretch;
    }
    const Eigen::Matrix3d frame = Eigen::Quaterniond(
      random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
                                    .normalized()
                                    .toRotationMatrix();
    IndexedTestMesh turned = flat;
    for (std::size_t k = 0; k < flat.positions.size(); k += 3)
    {
      Eigen::Vector3d::Map(&turned.positions[k]) = frame * Eigen::Vector3d::Map(&flat.positions[k]);
    }
    const StreamMesh one = toStream(flat), other = toStream(turned);
    DistanceDescription boundary;
    boundary.from.emplace_back(OnBoundary());
    boundary.accuracy = PathAccuracy::Exact;
    const Eigen::VectorXd there = measure(MemoryMesh(one), boundary).values.col(0);
    const Eigen::VectorXd here = measure(MemoryMesh(other), boundary).values.col(0);
    // In the same order: that of the stream does not look at positions.
    ASSERT_EQ(one.originalIds, other.originalIds);
    EXPECT_LT((there - here).cwiseAbs().maxCoeff(), 1e-9) << "run " << run;
  }
}

/** As scans have them: points snapped to a grid, where many coincide and triangles have no area or
 * tiny ones. Where a path of no length leads to and fro, rounding must not make it shorter each
 * time.
 */
TEST(DistanceRounding, ExactOnesEndWherePointsCoincide)
{
  Random random(37);
  for (int run = 0; run < 200; ++run)
  {
    IndexedTestMesh square = unitSquare(30, 0.45);
    const double step = 1.0 / (20 + double(random.below(80)));
    const double noise = std::pow(10.0, random.uniform(-10, -6));
    for (double& x : square.positions)
    {
      x = static_cast<float>(
        std::round(x / step) * step + (random.below(3) > 0 ? 0.0 : random.uniform(-noise, noise)));
    }
    const MemoryMesh mesh(toStream(square));
    const StreamMesh& stream = mesh.mesh();
    DistanceDescription description;
    description.accuracy = PathAccuracy::Exact;
    const Region::Sphere ball{ { random.uniform(0, 1), random.uniform(0, 1), 0 },
      random.uniform(0.1, 0.6) };
    description.from.emplace_back(Region(ball));
    const Solved found = measure(mesh, description);
    EXPECT_TRUE(found.report.converged);
    for (std::int64_t v = 0; v < stream.vertices(); ++v)
    {
      const double* const p = &stream.positions[3 * std::size_t(v)];
      const double outside = std::hypot(p[0] - ball.center[0], p[1] - ball.center[1]) - ball.radius;
      EXPECT_GE(found.values(v, 0), std::max(outside - 1e-5, 0.0)) << "run " << run;
    }
  }
}

} // namespace
} // namespace smg::testing
