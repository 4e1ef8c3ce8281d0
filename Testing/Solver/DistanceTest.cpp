// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

// Distances against exact ones: straight lines in flat surfaces and solids, great circles, curves
// and surfaces as sources.

namespace smg::testing
{

TEST(Distance, InAFlatSquareIsExact)
{
  const MemoryMesh mesh(toStream(unitSquare(60)));
  const std::int64_t source = nearestTo(mesh.mesh(), 0.3, 0.2, 0);
  const RelativeErrors errors = errorsOf(
    measure(mesh, fromVertices({ source })), mesh.mesh(), straightFrom(mesh.mesh(), source));
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(Distance, InAnyUnitIsTheSame)
{
  const IndexedTestMesh square = unitSquare(20);
  const Eigen::MatrixXd expected =
    measure(MemoryMesh(toStream(square)), fromVertices({ 0 })).values;
  for (const int exponent : { -150, 150 })
  {
    IndexedTestMesh scaled = square;
    for (double& x : scaled.positions)
    {
      x = std::ldexp(x, exponent);
    }
    Eigen::MatrixXd values = measure(MemoryMesh(toStream(scaled)), fromVertices({ 0 })).values;
    values *= std::ldexp(1.0, -exponent);
    EXPECT_EQ(values, expected) << "unit 2^" << exponent;
  }
}

TEST(Distance, InAnObtuseMeshIsExact)
{
  for (const double stretch : { 4.0, 16.0 })
  {
    IndexedTestMesh square = unitSquare(60);
    for (std::size_t k = 0; k < square.positions.size(); k += 3)
    {
      square.positions[k] *= stretch;
    }
    const MemoryMesh mesh(toStream(square));
    const std::int64_t source = nearestTo(mesh.mesh(), 0.3 * stretch, 0.2, 0);
    const RelativeErrors errors = errorsOf(
      measure(mesh, fromVertices({ source })), mesh.mesh(), straightFrom(mesh.mesh(), source));
    // At 16 times, some paths cross many cells at a very flat angle.
    EXPECT_LT(errors.mean, stretch < 10 ? 1e-6 : 1e-3) << "stretched " << stretch << " times";
  }
}

TEST(Distance, InACubeIsExact)
{
  const MemoryMesh mesh(toStream(unitCube(16)));
  const std::int64_t source = nearestTo(mesh.mesh(), 0.4, 0.5, 0.3);
  const RelativeErrors errors = errorsOf(
    measure(mesh, fromVertices({ source })), mesh.mesh(), straightFrom(mesh.mesh(), source));
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(Distance, OnASphereIsTheGreatCircle)
{
  const MemoryMesh mesh(toStream(sphere(6)));
  ASSERT_EQ(mesh.mesh().vertices(), 40962);
  const auto straight = straightFrom(mesh.mesh(), 1000);
  const RelativeErrors errors = errorsOf(measure(mesh, fromVertices({ 1000 })), mesh.mesh(),
    [&](const double* p) { return 2 * std::asin(std::min(1.0, straight(p) / 2)); });
  EXPECT_LT(errors.mean, 1e-3);
  EXPECT_LT(errors.largest, 5e-3);
}

TEST(Distance, FromAnEdgeOfTheSquareIsExact)
{
  const MemoryMesh mesh(toStream(unitSquare(60)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::HalfSpace{ { -1, 0, 0 }, 0 }));
  const RelativeErrors errors =
    errorsOf(measure(mesh, description), mesh.mesh(), [](const double* p) { return p[0]; });
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(Distance, FromHalfAnEdgeHasAStraightAndARoundFront)
{
  const MemoryMesh mesh(toStream(unitSquare(100)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::Box{ { 0, 0, 0 }, { 0, 0.5, 0 } }));
  const RelativeErrors errors = errorsOf(measure(mesh, description), mesh.mesh(),
    [](const double* p) { return std::hypot(p[0], std::max(p[1] - 0.5, 0.0)); });
  EXPECT_LT(errors.mean, 2e-3);
}

namespace
{

/** The ring between the radii 0.3 and 1, in `n` rings of 2 n vertices. */
StreamMesh ringMesh(int n)
{
  IndexedTestMesh mesh;
  for (int r = 0; r <= n; ++r)
  {
    for (int a = 0; a < 2 * n; ++a)
    {
      const double angle = M_PI * (a + 0.5 * r) / n, radius = 0.3 + 0.7 * r / n;
      mesh.positions.insert(
        mesh.positions.end(), { radius * std::cos(angle), radius * std::sin(angle), 0.0 });
      const std::int64_t v = 2 * n * r + a, w = 2 * n * r + (a + 1) % (2 * n);
      if (r < n)
      {
        mesh.corners.insert(mesh.corners.end(), { v, w, v + 2 * n, w, w + 2 * n, v + 2 * n });
      }
    }
  }
  return toStream(mesh);
}

} // namespace

TEST(Distance, FromACircleConverges)
{
  DistanceDescription description;
  description.from.emplace_back(Region(Region::Sphere{ { 0, 0, 0 }, 0.3 + 1e-9 }));
  double before = 0.025;
  for (const int n : { 40, 80 })
  {
    const MemoryMesh mesh(ringMesh(n));
    const RelativeErrors errors = errorsOf(measure(mesh, description), mesh.mesh(),
      [](const double* p)
      { return std::hypot(p[0], p[1]) < 0.3 + 1e-9 ? 0 : std::hypot(p[0], p[1]) - 0.3; });
    EXPECT_LT(errors.mean, before);
    before = 0.6 * errors.mean;
  }
}

TEST(Distance, FromAFaceOfTheCubeIsExact)
{
  const MemoryMesh mesh(toStream(unitCube(16)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::HalfSpace{ { 0, 0, -1 }, 0 }));
  const RelativeErrors errors =
    errorsOf(measure(mesh, description), mesh.mesh(), [](const double* p) { return p[2]; });
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(Distance, FromTheBoundaryOfTheCubeFollowsItsFaces)
{
  const MemoryMesh mesh(toStream(unitCube(16)));
  DistanceDescription description;
  description.from.emplace_back(OnBoundary{});
  const RelativeErrors errors = errorsOf(measure(mesh, description), mesh.mesh(),
    [](const double* p)
    {
      const auto depth = [](double x) { return std::min(x, 1 - x); };
      return std::max(std::min({ depth(p[0]), depth(p[1]), depth(p[2]) }), 0.0);
    });
  EXPECT_LT(errors.mean, 0.03);
}

TEST(Distance, OfSeveralSourcesIsThatOfTheNearest)
{
  const MemoryMesh mesh(toStream(unitSquare(100)));
  std::vector<std::int64_t> sources;
  Random random(7);
  for (int k = 0; k < 10; ++k)
  {
    sources.push_back(random.below(mesh.mesh().vertices()));
  }
  DistanceDescription description = fromVertices(sources);
  description.source = true;
  const Solved solved = measure(mesh, description);
  const auto nearest = [&](const double* p)
  {
    double least = HUGE_VAL;
    for (const std::int64_t source : sources)
    {
      least = std::min(least, straightFrom(mesh.mesh(), source)(p));
    }
    return least;
  };
  const RelativeErrors errors = errorsOf(solved, mesh.mesh(), nearest);
  EXPECT_LT(errors.mean, 5e-4);
  EXPECT_EQ(solved.report.distance->sources, 10);
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    const double* p = mesh.mesh().positions.data() + 3 * v;
    const auto named = static_cast<std::int64_t>(solved.values(v, 1));
    ASSERT_NE(std::ranges::find(sources, named), sources.end());
    // Between two equally near sources either is right.
    EXPECT_LT(straightFrom(mesh.mesh(), named)(p), nearest(p) + 0.02);
  }
}

TEST(Distance, HasTheUnitGradient)
{
  const std::array<MemoryMesh, 2> meshes{ MemoryMesh(toStream(unitSquare(40))),
    MemoryMesh(toStream(unitCube(10))) };
  for (const MemoryMesh& mesh : meshes)
  {
    const std::int64_t source = nearestTo(mesh.mesh(), 0.3, 0.2, 0.4);
    DistanceDescription description = fromVertices({ source });
    description.direction = true;
    // In chunks that cells cross, too.
    for (const Solved& solved :
      { measure(mesh, description), measureInChunks(mesh, description, 1) })
    {
      ASSERT_EQ(solved.values.cols(), 4);
      const double* s = mesh.mesh().positions.data() + 3 * source;
      for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
      {
        const double* p = mesh.mesh().positions.data() + 3 * v;
        for (int k = 0; k < 3; ++k)
        {
          const double exact = v == source ? 0 : (p[k] - s[k]) / solved.values(v, 0);
          EXPECT_NEAR(solved.values(v, 1 + k), exact, 1e-5);
        }
      }
    }
  }
}

TEST(Distance, AcrossASeamOfThreeSheetsIsExact)
{
  // Each two of the sheets unfold to a plane.
  const IndexedTestMesh square = unitSquare(30);
  IndexedTestMesh sheets;
  for (const double angle : { 0.0, 2.0, 4.0 })
  {
    const auto first = sheets.vertices();
    std::vector<std::int64_t> number;
    for (std::int64_t v = 0; v < square.vertices(); ++v)
    {
      const double x = square.positions[3 * v], y = square.positions[3 * v + 1];
      // All sheets have the vertices of the first one where x is 0.
      const bool shared = x == 0 && angle > 0;
      number.push_back(shared ? v : sheets.vertices());
      if (!shared)
      {
        sheets.positions.insert(
          sheets.positions.end(), { x * std::cos(angle), y, x * std::sin(angle) });
      }
    }
    ASSERT_GE(sheets.vertices(), first);
    for (const std::int64_t corner : square.corners)
    {
      sheets.corners.push_back(number[corner]);
    }
  }
  const MemoryMesh mesh(toStream(sheets));
  const std::int64_t source = nearestTo(mesh.mesh(), 0.5, 0.3, 0);
  const double x = mesh.mesh().positions[3 * source], y = mesh.mesh().positions[3 * source + 1];
  const RelativeErrors errors = errorsOf(measure(mesh, fromVertices({ source })), mesh.mesh(),
    [x, y](const double* p)
    {
      const double across = std::hypot(p[0], p[2]);
      return std::hypot(x - (p[2] == 0 ? across : -across), y - p[1]);
    });
  EXPECT_LT(errors.largest, 1e-6);
}

} // namespace smg::testing
