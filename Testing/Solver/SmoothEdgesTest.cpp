// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/FairingProblem.h"
#include "Testing/Solver/SmoothTesting.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <map>

namespace smg::testing
{
namespace
{

/** The surface of the cube [0, n]^3, in triangles with legs of length 1. */
IndexedTestMesh cube(int n)
{
  IndexedTestMesh mesh;
  std::map<std::array<int, 3>, std::int64_t> vertices;
  const auto vertex = [&](const std::array<int, 3>& point)
  {
    const auto [place, isNew] = vertices.try_emplace(point, mesh.vertices());
    if (isNew)
    {
      mesh.positions.insert(mesh.positions.end(), point.begin(), point.end());
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int side : { 0, n })
    {
      for (int i = 0; i < n * n; ++i)
      {
        const auto corner = [&](int du, int dv)
        {
          std::array<int, 3> point{};
          point[static_cast<std::size_t>(axis)] = side;
          point[static_cast<std::size_t>((axis + 1) % 3)] = i % n + (side > 0 ? du : dv);
          point[static_cast<std::size_t>((axis + 2) % 3)] = i / n + (side > 0 ? dv : du);
          return vertex(point);
        };
        const std::int64_t q[4] = { corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1) };
        mesh.corners.insert(mesh.corners.end(), { q[0], q[1], q[2], q[0], q[2], q[3] });
      }
    }
  }
  return mesh;
}

/** The mean angle in degrees between the normals of two positions of a mesh. */
double normalError(const StreamMesh& mesh, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  double sum = 0.0;
  const auto normal = [&](const Eigen::MatrixXd& points, std::int64_t c) -> Eigen::Vector3d
  {
    const auto corner = [&](std::int64_t k) -> Eigen::Vector3d
    { return points.row(mesh.corners[static_cast<std::size_t>(3 * c + k)]); };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  };
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    sum += std::acos(std::clamp(normal(a, c).dot(normal(b, c)), -1.0, 1.0));
  }
  return sum / static_cast<double>(mesh.cells()) * 180.0 / std::numbers::pi;
}

/** The root mean square of the distance of the points from the surface of the cube [0, n]^3. */
double distanceFromCube(const Eigen::MatrixXd& points, double n)
{
  double sum = 0.0;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
  {
    const Eigen::Array3d out = (points.row(v).array() - 0.5 * n).abs() - 0.5 * n;
    const double inside = std::min(out.maxCoeff(), 0.0);
    sum += out.max(0.0).matrix().squaredNorm() + inside * inside;
  }
  return std::sqrt(sum / static_cast<double>(points.rows()));
}

} // namespace

TEST(SmoothEdges, ANoisyCubeKeepsThemAndBecomesFlat)
{
  constexpr int N = 16;
  const StreamMesh exact = toStream(cube(N));
  const StreamMesh rough = noisy(exact, 0.35); // 0.2 in the mean square, of edges of 1 and 1.4
  const Eigen::MatrixXd goal = pointsOf(exact);
  Smoothing options;
  options.size.value = 6.0;
  options.steps = 5;
  const Eigen::MatrixXd round = smoothed(rough, options).values;
  options.keepEdges = 30.0;
  const Solved sharp = smoothed(rough, options);

  const double before = normalError(exact, pointsOf(rough), goal);
  EXPECT_LT(normalError(exact, sharp.values, goal), 0.25 * before);
  EXPECT_LT(normalError(exact, sharp.values, goal), 0.6 * normalError(exact, round, goal));
  EXPECT_LT(distanceFromCube(sharp.values, N), 0.5 * distanceFromCube(pointsOf(rough), N));
  EXPECT_LT(distanceFromCube(sharp.values, N), 0.5 * distanceFromCube(round, N));
  EXPECT_NEAR(enclosedVolume(exact, sharp.values), enclosedVolume(exact, pointsOf(rough)), 1e-6);
  ASSERT_EQ(sharp.report.steps.size(), 10U);
  EXPECT_EQ(sharp.report.steps[8].name, "presmoothing 5");
}

TEST(SmoothEdges, AnAngleThatNothingTurnsByKeepsNone)
{
  // Up to the surface of the stiffness, an isotropic step.
  const StreamMesh rough = noisy(toStream(cube(8)), 0.1);
  Smoothing options;
  options.tolerance = 1e-10;
  options.keepVolume = false;
  options.size = { 4.0, SmoothingSize::Mesh };
  const Eigen::MatrixXd x = pointsOf(rough);
  const double t = timeOf(4.0, 1);
  const Eigen::MatrixXd presmoothed =
    smoothDirectly(lumpedMass(rough, x), stiffness(rough, x), t, x, {});
  const Eigen::MatrixXd expected =
    smoothDirectly(lumpedMass(rough, presmoothed), stiffness(rough, presmoothed), t, x, {});
  options.keepEdges = 179.0;
  const Eigen::MatrixXd all = smoothed(rough, options).values;
  EXPECT_LT((all - expected).cwiseAbs().maxCoeff(), 0.01 * (x - expected).cwiseAbs().maxCoeff());
}

TEST(EdgeConductivity, IsSmallAcrossABendAndOneAlongIt)
{
  // On a cylinder of radius 2 around z, the curvatures are 1 / 2 and 0.
  const auto at = [](double angle, double z)
  { return Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), z); };
  const Eigen::Vector3d points[3] = { at(-0.01, 0), at(0.01, 0), at(0, 0.02) };
  Eigen::Vector3d normals[3];
  const double* p[3];
  const double* n[3];
  for (int k = 0; k < 3; ++k)
  {
    normals[k] = Eigen::Vector3d(points[k][0], points[k][1], 0).normalized();
    p[k] = points[k].data();
    n[k] = normals[k].data();
  }
  const std::array<double, 6> K = EdgeConductivity(0.8, 0.2).at(p, n);
  const double across = 1.0 / (1.0 + std::pow(0.5 * 0.8 / 0.2, 4.0));
  EXPECT_NEAR(K[1], across, 1e-3);
  EXPECT_NEAR(K[2], 1.0, 1e-3);
  EXPECT_NEAR(K[0], 1.0, 1e-3);
  for (const int k : { 3, 4, 5 })
  {
    EXPECT_NEAR(K[static_cast<std::size_t>(k)], 0.0, 1e-2);
  }
}

TEST(EdgeConductivity, IsTheSameForEveryOrderOfTheCorners)
{
  Random random(5);
  double points[3][3], normals[3][3];
  for (auto* of : { &points, &normals })
  {
    for (auto& row : *of)
    {
      std::ranges::generate(row, [&] { return random.uniform(-1.0, 1.0); });
    }
  }
  const EdgeConductivity conductivity(1.0, 0.5);
  const auto of = [&](int a, int b, int c)
  {
    const double* p[3] = { points[a], points[b], points[c] };
    const double* n[3] = { normals[a], normals[b], normals[c] };
    return conductivity.at(p, n);
  };
  const std::array<double, 6> expected = of(0, 1, 2);
  for (const std::array<double, 6>& K : { of(1, 2, 0), of(2, 1, 0) })
  {
    for (std::size_t k = 0; k < 6; ++k)
    {
      EXPECT_NEAR(K[k], expected[k], 1e-12);
    }
  }
}

} // namespace smg::testing
