// SPDX-License-Identifier: BSD-3-Clause
#include "smg/CellWeights.h"
#include "Solver/Assembly/Elements.h"
#include "Testing/Support/TestMeshes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace smg::testing
{
namespace
{

using Point = Eigen::Vector3d;

Point randomPoint(Random& random)
{
  return { random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1) };
}

smg::CellWeights weightsOf(const std::vector<Point>& p)
{
  return p.size() == 3 ? triangleWeights(p[0].data(), p[1].data(), p[2].data())
                       : tetrahedronWeights(p[0].data(), p[1].data(), p[2].data(), p[3].data());
}

double cotangent(const Point& a, const Point& b)
{
  const double angle = std::acos(a.dot(b) / (a.norm() * b.norm()));
  return 1.0 / std::tan(angle);
}

/** The angle between two faces of a tetrahedron at the edge p q; r and s are the other corners. */
double dihedralAngle(const Point& p, const Point& q, const Point& r, const Point& s)
{
  const Point axis = (q - p).normalized();
  const Point u = (r - p) - axis.dot(r - p) * axis;
  const Point v = (s - p) - axis.dot(s - p) * axis;
  return std::acos(u.dot(v) / (u.norm() * v.norm()));
}

/** -integral of grad phi_i . grad phi_j over a tetrahedron, by inverting the matrix of corners. */
Eigen::Matrix4d stiffness(const std::vector<Point>& p)
{
  Eigen::Matrix4d corners;
  for (int k = 0; k < 4; ++k)
  {
    corners.row(k) << 1.0, p[static_cast<std::size_t>(k)].transpose();
  }
  const Eigen::Matrix<double, 3, 4> gradients = corners.inverse().bottomRows<3>();
  return std::fabs(corners.determinant()) / 6.0 * gradients.transpose() * gradients;
}

} // namespace

TEST(CellWeights, OfATriangleAreHalfTheCotangents)
{
  Random random(3);
  for (int trial = 0; trial < 200; ++trial)
  {
    const std::vector<Point> p{ randomPoint(random), randomPoint(random), randomPoint(random) };
    const smg::CellWeights cell = weightsOf(p);
    EXPECT_NEAR(cell.measure, 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm(), 1e-14);
    for (int e = 0; e < 3; ++e)
    {
      const int opposite = 3 - TriangleEdges[e][0] - TriangleEdges[e][1];
      const double expected =
        0.5 * cotangent(p[TriangleEdges[e][0]] - p[opposite], p[TriangleEdges[e][1]] - p[opposite]);
      EXPECT_NEAR(cell.weight[e], expected, 1e-9 * (1.0 + std::fabs(expected)));
    }
  }
}

TEST(CellWeights, OfATetrahedronAreTheStiffnessAndTheDihedralFormula)
{
  Random random(4);
  for (int trial = 0; trial < 200; ++trial)
  {
    const std::vector<Point> p{ randomPoint(random), randomPoint(random), randomPoint(random),
      randomPoint(random) };
    const smg::CellWeights cell = weightsOf(p);
    const Eigen::Matrix4d expected = stiffness(p);
    const double scale = expected.cwiseAbs().maxCoeff();
    for (int e = 0; e < 6; ++e)
    {
      const int i = TetrahedronEdges[e][0];
      const int j = TetrahedronEdges[e][1];
      const int r = TetrahedronEdges[5 - e][0];
      const int s = TetrahedronEdges[5 - e][1];
      EXPECT_NEAR(cell.weight[e], -expected(i, j), 1e-10 * scale);
      const double angle = dihedralAngle(p[r], p[s], p[i], p[j]);
      EXPECT_NEAR(cell.weight[e], (p[r] - p[s]).norm() / 6.0 / std::tan(angle), 1e-8 * scale);
    }
  }
}

TEST(CellWeights, DoNotDependOnOrientationOrPlace)
{
  const std::vector<Point> p{ { 0, 0, 0 }, { 1, 0, 0 }, { 0.2, 0.9, 0 }, { 0.3, 0.1, 0.8 } };
  const smg::CellWeights cell = weightsOf(p);
  const smg::CellWeights turned = weightsOf({ p[1], p[0], p[2], p[3] });
  EXPECT_GT(cell.measure, 0.0);
  EXPECT_NEAR(turned.measure, cell.measure, 1e-15);
  EXPECT_NEAR(turned.weight[0], cell.weight[0], 1e-15);
  EXPECT_NEAR(turned.weight[1], cell.weight[3], 1e-15);
  EXPECT_NEAR(turned.weight[5], cell.weight[5], 1e-15);

  std::vector<Point> moved = p;
  for (Point& point : moved)
  {
    point += Point(10, -20, 30);
  }
  for (int e = 0; e < 6; ++e)
  {
    EXPECT_NEAR(weightsOf(moved).weight[e], cell.weight[e], 1e-13);
  }
}

TEST(CellWeights, OfSimpleCells)
{
  const smg::CellWeights right = weightsOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_DOUBLE_EQ(right.measure, 0.5);
  EXPECT_DOUBLE_EQ(right.weight[0], 0.5);
  EXPECT_DOUBLE_EQ(right.weight[1], 0.5);
  EXPECT_DOUBLE_EQ(right.weight[2], 0.0);
  const double height = std::numbers::sqrt3 / 2;
  const smg::CellWeights equilateral = weightsOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, height, 0 } });
  EXPECT_NEAR(equilateral.weight[1], 0.5 / std::numbers::sqrt3, 1e-15);
  const smg::CellWeights obtuse = weightsOf({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0.1, 0 } });
  EXPECT_LT(obtuse.weight[0], 0.0);
}

TEST(CellWeights, OfASliverAreFinite)
{
  const smg::CellWeights triangle = weightsOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1e-12, 0 } });
  EXPECT_NEAR(triangle.measure, 5e-13, 1e-16);
  const smg::CellWeights tetrahedron =
    weightsOf({ { 0, 0, 0 }, { 1, 1, 1e-10 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_GT(tetrahedron.measure, 0.0);
  for (int e = 0; e < 6; ++e)
  {
    EXPECT_TRUE(std::isfinite(triangle.weight[e]));
    EXPECT_TRUE(std::isfinite(tetrahedron.weight[e]));
  }
}

TEST(CellWeights, OfADegenerateCellAreNone)
{
  const Point a(1, 2, 3);
  const Point b(2, 4, 6);
  const Point c(3, 6, 9);
  const Point d(0, 1, 0);
  for (const auto& points :
    { std::vector{ a, a, d }, std::vector{ a, a, a }, std::vector{ a, b, c },
      std::vector{ a, a, b, d }, std::vector{ a, b, c, d }, std::vector{ d, d, d, d },
      std::vector<Point>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } },
      std::vector<Point>{ { 0, 0, 0 }, { 1e-200, 0, 0 }, { 0, 1e-200, 0 } } })
  {
    const smg::CellWeights cell = weightsOf(points);
    EXPECT_EQ(cell.measure, 0.0);
    for (const double weight : cell.weight)
    {
      EXPECT_EQ(weight, 0.0);
    }
  }
}

/** In the interior of a flat mesh sum_j w_ij (x_i - x_j) = 0 for every coordinate x. */
TEST(CellWeights, MakeLinearFunctionsHarmonic)
{
  for (const bool surface : { true, false })
  {
    const IndexedTestMesh mesh = surface ? grid(9, 8, 0.25) : tetBox(5, 6, 5, 0.15);
    const int size = cornersOf(mesh.cellType);
    Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(mesh.vertices(), 3);
    const auto point = [&](std::int64_t v) { return Point(&mesh.positions[3 * v]); };
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      std::vector<Point> points;
      for (int k = 0; k < size; ++k)
      {
        points.push_back(point(mesh.corners[size * c + k]));
      }
      const smg::CellWeights cell = weightsOf(points);
      for (int e = 0; e < size * (size - 1) / 2; ++e)
      {
        const int* ends = surface ? TriangleEdges[e] : TetrahedronEdges[e];
        const Point flow = cell.weight[e] * (points[ends[0]] - points[ends[1]]);
        laplacian.row(mesh.corners[size * c + ends[0]]) += flow;
        laplacian.row(mesh.corners[size * c + ends[1]]) -= flow;
      }
    }
    const auto isInside = [&](const Point& p)
    {
      return surface ? p.x() > 0.9 && p.x() < 7.1 && p.y() > 0.5 && p.y() < 5.5
                     : p.minCoeff() > 0.5 && p.x() < 3.5 && p.y() < 4.5 && p.z() < 3.5;
    };
    int inside = 0;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      if (isInside(point(v)))
      {
        ++inside;
        EXPECT_LT(laplacian.row(v).norm(), 1e-13);
      }
    }
    EXPECT_GT(inside, 20);
  }
}

TEST(CellWeights, HaveAFloorOfAThousandthOfARegularMesh)
{
  const Point a(0, 0, 0);
  const Point b(0, 3, 4);
  EXPECT_DOUBLE_EQ(cotangentFloor(CellType::Triangle, a.data(), b.data()), 5e-4);
  EXPECT_DOUBLE_EQ(cotangentFloor(CellType::Tetrahedron, a.data(), b.data()), 5e-4);
}

TEST(CellWeights, OfAConductivityAreTheElementMatrixWithIt)
{
  Random random(5);
  for (int trial = 0; trial < 200; ++trial)
  {
    // K = R R^T + a diagonal, with eigenvalues of very different sizes.
    Eigen::Matrix3d root;
    for (int k = 0; k < 9; ++k)
    {
      root(k / 3, k % 3) = random.uniform(-1, 1);
    }
    const Eigen::Matrix3d k = root * root.transpose() + 0.01 * Eigen::Matrix3d::Identity();
    const double tensor[6] = { k(0, 0), k(1, 1), k(2, 2), k(0, 1), k(1, 2), k(0, 2) };
    ASSERT_TRUE(isPositiveDefinite(tensor));
    for (const int corners : { 3, 4 })
    {
      const auto type = static_cast<CellType>(corners);
      std::vector<Point> p;
      const double* points[4] = {};
      for (int c = 0; c < corners; ++c)
      {
        p.push_back(randomPoint(random));
      }
      Eigen::MatrixXd jacobian(3, corners - 1);
      for (int c = 0; c < corners; ++c)
      {
        points[c] = p[static_cast<std::size_t>(c)].data();
        if (c > 0)
        {
          jacobian.col(c - 1) = p[static_cast<std::size_t>(c)] - p[0];
        }
      }
      const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
      Eigen::MatrixXd gradients(corners, 3);
      gradients.bottomRows(corners - 1) = gram.inverse() * jacobian.transpose();
      gradients.row(0) = -gradients.bottomRows(corners - 1).colwise().sum();
      const double measure = std::sqrt(gram.determinant()) / (corners == 3 ? 2 : 6);
      const Eigen::MatrixXd element = measure * gradients * k * gradients.transpose();
      const smg::CellWeights cell = conductivityWeights(type, points, tensor);
      EXPECT_NEAR(cell.measure, measure, 1e-10 * measure);
      for (int e = 0; e < edgesOf(type); ++e)
      {
        const int* ends = edgeCorners(type, e);
        EXPECT_NEAR(cell.weight[e], -element(ends[0], ends[1]), 1e-9 * element.norm());
      }
    }
  }
}

TEST(CellWeights, OfAScalarConductivityAreItsMultiplesBitForBit)
{
  Random random(6);
  const double tensor[6] = { 0.3, 0.3, 0.3, 0, 0, 0 };
  for (const int corners : { 3, 4 })
  {
    const std::vector<Point> p{ randomPoint(random), randomPoint(random), randomPoint(random),
      randomPoint(random) };
    const double* points[4] = { p[0].data(), p[1].data(), p[2].data(), p[3].data() };
    const auto type = static_cast<CellType>(corners);
    const smg::CellWeights plain = smg::cellWeights(type, points);
    const smg::CellWeights scaled = conductivityWeights(type, points, tensor);
    for (int e = 0; e < edgesOf(type); ++e)
    {
      EXPECT_EQ(scaled.weight[e], 0.3 * plain.weight[e]);
    }
  }
}

TEST(CellWeights, AConductivityMustBePositiveDefinite)
{
  const double nan = std::nan("");
  const std::vector<std::vector<double>> bad{ { 0, 1, 1, 0, 0, 0 }, { 1, -1, 1, 0, 0, 0 },
    { 1, 1, 1, 1, 0, 0 }, { 1, 1, 1, 0, 0, -2 }, { 1, 1, 1, 0.9, 0.9, -0.9 },
    { -1, -1, -1, 0, 0, 0 }, { 0, 0, 0, 0, 0, 0 }, { nan, 1, 1, 0, 0, 0 }, { 1, 1, 1, nan, 0, 0 },
    { HUGE_VAL, 1, 1, 0, 0, 0 } };
  for (const std::vector<double>& tensor : bad)
  {
    EXPECT_FALSE(isPositiveDefinite(tensor.data()));
  }
  const std::vector<std::vector<double>> good{ { 1, 1, 1, 0, 0, 0 },
    { 1e-200, 1e-200, 1e-200, 0, 0, 0 }, { 1e200, 1e200, 1e200, 9e199, 0, 0 },
    { 1, 1e-6, 1, 0, 0, 0 }, { 1, 1, 1, 0.9, 0.9, 0.9 } };
  for (const std::vector<double>& tensor : good)
  {
    EXPECT_TRUE(isPositiveDefinite(tensor.data()));
  }
}

TEST(CellWeights, TheFlatnessOfACellIsAMatterOfItsShape)
{
  for (const int corners : { 3, 4 })
  {
    const double flat[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.4, corners == 3 ? 1e-8 : 0.5, 0 },
      { 0.3, 0.2, 1e-7 } };
    const auto type = static_cast<CellType>(corners);
    double expected = 0.0;
    for (const double unit : { 1.0, 1e-6, 1e6 })
    {
      double scaled[4][3];
      const double* points[4] = {};
      for (int c = 0; c < 4; ++c)
      {
        std::transform(flat[c], flat[c] + 3, scaled[c], [=](double x) { return unit * x; });
        points[c] = scaled[c];
      }
      const double factor = flatnessFactor(type, points, smg::cellWeights(type, points));
      EXPECT_LT(factor, 1.0);
      expected = expected == 0.0 ? factor : expected;
      EXPECT_NEAR(factor, expected, 1e-9 * expected);
    }
  }
}

} // namespace smg::testing
