// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Estimate/Costs.h"
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
  // A point, and a part of an edge.
  for (const std::vector<std::int64_t>& ids : { std::vector<std::int64_t>{ 0 }, { 0, 1, 2, 3, 4 } })
  {
    const auto measured = [&](double unit)
    {
      IndexedTestMesh scaled = square;
      std::ranges::for_each(scaled.positions, [unit](double& x) { x *= unit; });
      return measure(MemoryMesh(toStream(scaled, TestOrder::Keep)), fromVertices(ids)).values;
    };
    const Eigen::MatrixXd expected = measured(1);
    for (const double unit : { 0x1p-150, 0x1p-100, 0x1p100, 0x1p150 })
    {
      EXPECT_EQ(measured(unit) / unit, expected) << "unit " << unit;
    }
    for (const double unit : { 1e-30, 1e30 })
    {
      EXPECT_LT((measured(unit) / unit - expected).cwiseAbs().maxCoeff(), 1e-6) << "unit " << unit;
    }
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
  DistanceDescription description = fromVertices({ 1000 });
  description.accuracy = PathAccuracy::Approximate;
  const RelativeErrors errors = errorsOf(measure(mesh, description), mesh.mesh(),
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
  const Solved solved = measure(mesh, description);
  const auto exact = [](const double* p) { return std::hypot(p[0], std::max(p[1] - 0.5, 0.0)); };
  EXPECT_LT(errorsOf(solved, mesh.mesh(), exact).mean, 5e-4);
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    // A tenth of an edge.
    EXPECT_NEAR(solved.values(v, 0), exact(mesh.mesh().positions.data() + 3 * v), 1e-3);
  }
}

TEST(Distance, FromAnInnerSegmentIsExactInARegularMesh)
{
  // The normals at its ends are edges of the mesh.
  const MemoryMesh mesh(toStream(unitSquare(50, 0)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::Box{ { 0.5, 0.3, 0 }, { 0.5, 0.7, 0 } }));
  const RelativeErrors errors = errorsOf(measure(mesh, description), mesh.mesh(),
    [](const double* p) {
      return std::hypot(p[0] - 0.5, std::max({ 0.3 - p[1], p[1] - 0.7, 0.0 }));
    });
  EXPECT_LT(errors.mean, 1e-6);
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(Distance, FromTwoNeighboursIsLocal)
{
  // They are a curve of one edge; what another source reaches first stays exact.
  const MemoryMesh mesh(toStream(unitSquare(60, 0)));
  const auto at = [&](double x, double y) { return nearestTo(mesh.mesh(), x, y, 0); };
  const std::vector<std::int64_t> sources{ at(0.8, 0.5), at(0.8, 0.5 + 1.0 / 60), at(0.1, 0.1) };
  const Solved solved = measure(mesh, fromVertices(sources));
  const auto straight = straightFrom(mesh.mesh(), sources[2]);
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    const double* p = mesh.mesh().positions.data() + 3 * v;
    const double beyond = std::max({ 0.5 - p[1], p[1] - 0.5 - 1.0 / 60, 0.0 });
    const double other = std::hypot(p[0] - 0.8, beyond);
    EXPECT_NEAR(solved.values(v, 0), std::min(straight(p), other), 0.5 / 60);
    if (straight(p) < other - 0.1)
    {
      EXPECT_NEAR(solved.values(v, 0), straight(p), 1e-6);
    }
  }
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

TEST(Distance, AlongAStripOfNearlyFlatTrianglesIsThatToItsNearerEnd)
{
  // Each vertex lies between its neighbours, both as far as it from the nearest source.
  constexpr std::int64_t Last = 30;
  IndexedTestMesh strip;
  for (std::int64_t v = 0; v <= Last; ++v)
  {
    strip.positions.insert(
      strip.positions.end(), { static_cast<double>(v), v % 2 == 0 ? 0.0 : 0.01, 0.0 });
    if (v >= 2)
    {
      strip.corners.insert(strip.corners.end(), { v - 2, v - 1, v });
    }
  }
  const MemoryMesh mesh(toStream(strip));
  for (const bool edges : { false, true })
  {
    const std::int64_t end = edges ? 1 : 0; // sources are points or edges
    // In one window and in several.
    for (const std::int64_t chunk : { Last + 1, std::int64_t(4), std::int64_t(2) })
    {
      const Solved solved =
        measureInChunks(mesh, fromVertices({ 0, end, Last - end, Last }), chunk);
      for (std::int64_t v = 0; v <= Last; ++v)
      {
        const double expected =
          static_cast<double>(std::max<std::int64_t>(0, std::min(v, Last - v) - end));
        EXPECT_NEAR(solved.values(v, 0), expected, 1.1) << chunk;
      }
    }
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

TEST(Distance, OfALineHasItsNormalAsGradient)
{
  // Exactly and approximately, with and without numbers of sources, which differ along the line.
  // Along the sides, paths from its ends are as short, so that the front is taken for round there.
  const MemoryMesh mesh(toStream(unitSquare(40)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::HalfSpace{ { -1, 0, 0 }, 0 }));
  description.direction = true;
  for (const PathAccuracy accuracy : { PathAccuracy::Exact, PathAccuracy::Approximate })
  {
    for (const bool source : { false, true })
    {
      description.accuracy = accuracy;
      description.source = source;
      SCOPED_TRACE(std::to_string(int(accuracy)) + (source ? " with sources" : ""));
      const Solved solved = measure(mesh, description);
      for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
      {
        const bool isSource = mesh.mesh().positions[3 * std::size_t(v)] == 0.0;
        EXPECT_NEAR(solved.values(v, source ? 2 : 1), isSource ? 0.0 : 1.0, 1e-2);
      }
    }
  }
}

TEST(Distance, DirectionsPointAwayFromTheNearestSource)
{
  // In convex sets: of a side, and of several points.
  for (const bool solid : { false, true })
  {
    for (const double jitter : { 0.0, 0.2 })
    {
      const MemoryMesh mesh(toStream(solid ? unitCube(8, jitter) : unitSquare(30, jitter)));
      const auto place = [&mesh](std::int64_t v)
      { return Eigen::Vector3d(Eigen::Vector3d::Map(&mesh.mesh().positions[3 * v])); };
      const std::vector<std::int64_t> points{ nearestTo(mesh.mesh(), 0.2, 0.3, 0.2),
        nearestTo(mesh.mesh(), 0.7, 0.4, 0.9), nearestTo(mesh.mesh(), 0.5, 0.9, 0.1) };
      for (int axis = 0; axis < (solid ? 4 : 3); ++axis)
      {
        const bool ofPoints = axis == (solid ? 3 : 2);
        DistanceDescription description = fromVertices(points);
        if (!ofPoints)
        {
          Region::HalfSpace side{ {}, 0 };
          side.normal[static_cast<std::size_t>(axis)] = -1;
          description.from.assign(1, Region(side));
        }
        description.direction = true;
        SCOPED_TRACE(
          std::to_string(solid) + ' ' + std::to_string(jitter) + ' ' + std::to_string(axis));
        const Solved solved = measure(mesh, description);
        for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
        {
          Eigen::Vector3d foot = place(v);
          foot[ofPoints ? 0 : axis] = 0;
          double nearest = HUGE_VAL, second = HUGE_VAL;
          for (std::size_t p = 0; ofPoints && p < points.size(); ++p)
          {
            const double distance = (place(points[p]) - place(v)).norm();
            second = std::min(second, std::max(distance, nearest));
            foot = distance < nearest ? place(points[p]) : foot;
            nearest = std::min(nearest, distance);
          }
          const double distance = (place(v) - foot).norm();
          if (distance > 0 && (!ofPoints || second > (solid ? 1.5 : 1 + 1e-9) * nearest))
          {
            const Eigen::Vector3d direction = solved.values.row(v).tail<3>();
            EXPECT_LE((direction - (place(v) - foot) / distance).norm(), 1e-5) << v;
          }
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

/** Processor time, measured on two cores that other programs shared. */
TEST(Distance, ExactOnesOfScansTakeAtMostWhatIsExpected)
{
  struct Scan
  {
    const char* name;
    std::int64_t vertices;
    double microseconds; ///< per vertex
  };
  for (const Scan& scan :
    { Scan{ "bunny", 34'834, 18.0 }, { "armadillo", 43'243, 8.6 }, { "elephant", 44'460, 20.6 },
      { "horse", 48'485, 28.7 }, { "lucy", 49'987, 10.8 }, { "range map", 62'361, 24.1 },
      { "noisy bunny, refined", 139'122, 48.7 }, { "brain", 168'390, 14.7 },
      { "dragon", 437'645, 55.0 }, { "armadillo, refined twice", 691'858, 31.4 } })
  {
    StreamInfo info;
    info.vertices = scan.vertices;
    const double expected = distanceCosts(info, {}).seconds / static_cast<double>(scan.vertices);
    EXPECT_GE(expected, 1e-6 * scan.microseconds) << scan.name;
    EXPECT_LE(expected, 5e-6 * scan.microseconds) << scan.name;
  }
}

} // namespace smg::testing
