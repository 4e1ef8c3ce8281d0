// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Testing/Solver/SmoothTesting.h"

#include <gtest/gtest.h>

namespace smg::testing
{
namespace
{

using Points = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

SweptVolume sweptVolume(const StreamMesh& mesh, const Points& x, const Points& y, const Points& n)
{
  SweptVolume volume;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const double* corner[3][3];
    for (int k = 0; k < 3; ++k)
    {
      const std::int64_t v = mesh.corners[static_cast<std::size_t>(3 * c + k)];
      corner[0][k] = x.data() + 3 * v;
      corner[1][k] = y.data() + 3 * v;
      corner[2][k] = n.data() + 3 * v;
    }
    volume.add(corner[0], corner[1], corner[2]);
  }
  return volume;
}

} // namespace

TEST(SweptVolume, OfAClosedSurfaceIsTheDifferenceOfItsVolumes)
{
  const StreamMesh before = noisy(toStream(torus(12, 9)), 0.1, 1);
  const Points x = pointsOf(before);
  const Points y = pointsOf(noisy(before, 0.3, 2));
  const Points n = pointsOf(noisy(before, 0.5, 3));
  const SweptVolume volume = sweptVolume(before, x, y, n);
  for (const double c : { 0.0, 0.25, -0.5 })
  {
    const double expected = enclosedVolume(before, y + c * n) - enclosedVolume(before, x);
    EXPECT_NEAR(volume.at(c), expected, 1e-11);
  }
}

TEST(SweptVolume, ATriangleThatMovesStraightSweepsAPrism)
{
  const double a[3] = { 0, 0, 0 }, b[3] = { 2, 0, 0 }, c[3] = { 0, 1, 0 };
  const double up[3] = { 0, 0, 1 }, bUp[3] = { 2, 0, 1 }, cUp[3] = { 0, 1, 1 };
  const double* x[3] = { a, b, c };
  const double* y[3] = { up, bUp, cUp };
  const double* n[3] = { up, up, up };
  SweptVolume volume;
  volume.add(x, y, n);
  EXPECT_DOUBLE_EQ(volume.at(0.0), 1.0);
  EXPECT_DOUBLE_EQ(volume.at(2.0), 3.0);
  ASSERT_TRUE(volume.root(10.0).has_value());
  EXPECT_NEAR(*volume.root(10.0), -1.0, 1e-12);
  EXPECT_FALSE(volume.root(0.5).has_value());
}

TEST(SweptVolume, TheDistanceThatKeepsTheVolumeOfASphere)
{
  const StreamMesh ball = toStream(sphere(3));
  const Points x = pointsOf(ball);
  const Points y = 0.9 * x;
  const SweptVolume volume = sweptVolume(ball, x, y, x);
  ASSERT_TRUE(volume.root(1.0).has_value());
  EXPECT_NEAR(*volume.root(1.0), 0.1, 1e-12);
}

TEST(SweptVolume, WithoutAnyNormalThereIsNoDistance)
{
  const StreamMesh ball = toStream(sphere(1));
  const Points x = pointsOf(ball);
  EXPECT_FALSE(sweptVolume(ball, x, 0.9 * x, 0.0 * x).root(1.0).has_value());
}

} // namespace smg::testing
