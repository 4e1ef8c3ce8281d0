// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolutionRanges.h"

#include "Solver/Jobs/Distance/TriangleTree.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

// Distances to the walls of tetrahedral meshes, against exact ones and all triangles.

namespace smg::testing
{
namespace
{

DistanceDescription wallOf(std::vector<Where> from = {})
{
  DistanceDescription description;
  description.from = std::move(from);
  description.wall = description.source = description.direction = true;
  return description;
}

/** The boundary triangles of a mesh in memory. */
std::vector<TrianglePoints> boundaryTriangles(const StreamMesh& mesh)
{
  std::map<std::vector<std::int64_t>, int> uses;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    for (int k = 0; k < 4; ++k)
    {
      std::vector<std::int64_t> face;
      for (int n = 1; n < 4; ++n)
      {
        face.push_back(mesh.corners[4 * c + (k + n) % 4]);
      }
      std::ranges::sort(face);
      ++uses[face];
    }
  }
  std::vector<TrianglePoints> boundary;
  for (const auto& [face, count] : uses)
  {
    for (int k = 0; k < 3 && count == 1; ++k)
    {
      TrianglePoints& triangle = k == 0 ? boundary.emplace_back() : boundary.back();
      std::copy_n(mesh.positions.data() + 3 * face[k], 3, triangle.point[k]);
    }
  }
  return boundary;
}

/** The distance of a point to a triangle: to its edges, or to its plane where it lies above the
 * inside. In more digits than doubles have. */
double distanceTo(const TrianglePoints& triangle, const double* point)
{
  using Precise = Eigen::Matrix<long double, 3, 1>;
  const auto precise = [](const double* p)
  { return Eigen::Map<const Eigen::Vector3d>(p).cast<long double>().eval(); };
  const Precise x = precise(point);
  Precise corner[3];
  std::ranges::transform(triangle.point, corner, precise);
  const Precise normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  long double least = HUGE_VALL;
  bool isAbove = normal.squaredNorm() > 0;
  for (int k = 0; k < 3; ++k)
  {
    const Precise edge = corner[(k + 1) % 3] - corner[k], way = x - corner[k];
    const long double t = std::clamp(edge.dot(way) / edge.squaredNorm(), 0.0L, 1.0L);
    least = std::min(least, (way - t * edge).norm());
    isAbove = isAbove && normal.cross(edge).dot(way) >= 0;
  }
  return static_cast<double>(isAbove ? std::fabs(normal.normalized().dot(x - corner[0])) : least);
}

/** A cube with a spherical hole: the corners of cells near its middle are removed. */
StreamMesh hollowCube(int n)
{
  IndexedTestMesh cube = unitCube(n);
  IndexedTestMesh hollow = cube;
  hollow.corners.clear();
  for (std::int64_t c = 0; c < cube.cells(); ++c)
  {
    const std::int64_t* corner = cube.corners.data() + 4 * c;
    double middle[3] = {};
    for (int k = 0; k < 12; ++k)
    {
      middle[k % 3] += cube.positions[3 * corner[k / 3] + k % 3] / 4;
    }
    if (std::hypot(middle[0] - 0.5, middle[1] - 0.5, middle[2] - 0.5) > 0.2)
    {
      hollow.corners.insert(hollow.corners.end(), corner, corner + 4);
    }
  }
  return toStream(hollow);
}

} // namespace

TEST(WallDistance, IsThatOfAllBoundaryTriangles)
{
  const MemoryMesh mesh(hollowCube(12));
  const Solved solved = measure(mesh, wallOf());
  const std::vector<TrianglePoints> boundary = boundaryTriangles(mesh.mesh());
  EXPECT_EQ(solved.report.distance->sources, static_cast<std::int64_t>(boundary.size()));
  EXPECT_EQ(solved.report.passes, 1);
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    EXPECT_NEAR(
      solved.values(v, 0), straightTo(boundary, mesh.mesh().positions.data() + 3 * v), 1e-14);
  }
}

TEST(WallDistance, PointsAwayFromTheWall)
{
  const MemoryMesh mesh(hollowCube(10));
  const Solved solved = measure(mesh, wallOf());
  const std::vector<TrianglePoints> boundary = boundaryTriangles(mesh.mesh());
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    const double distance = solved.values(v, 0);
    const Eigen::RowVector3d direction = solved.values.row(v).tail(3);
    EXPECT_NEAR(direction.norm(), distance > 0 ? 1 : 0, 1e-6);
    const Eigen::RowVector3d foot =
      Eigen::Map<const Eigen::RowVector3d>(mesh.mesh().positions.data() + 3 * v) -
      distance * direction;
    EXPECT_NEAR(straightTo(boundary, foot.data()), 0, 1e-6);
    const double* source =
      mesh.mesh().positions.data() + 3 * static_cast<std::int64_t>(solved.values(v, 1));
    EXPECT_LT((Eigen::Map<const Eigen::RowVector3d>(source) - foot).norm(), 0.15);
  }
}

TEST(WallDistance, MayBeThatOfAPart)
{
  const MemoryMesh mesh(toStream(unitCube(12)));
  const Solved solved = measure(mesh, wallOf({ Region(Region::HalfSpace{ { 0, -1, 0 }, 0 }),
                                        Region(Region::HalfSpace{ { 1, 0, 0 }, 1 }) }));
  EXPECT_EQ(solved.report.distance->sources, 2 * 2 * 12 * 12);
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    const double* p = mesh.mesh().positions.data() + 3 * v;
    EXPECT_NEAR(solved.values(v, 0), std::min(p[1], 1 - p[0]), 1e-15);
  }
}

TEST(WallDistance, DoesNotDependOnMemoryThreadsAndBlocks)
{
  // The boundary in parts: as many passes as there are.
  StreamMesh stream = toStream(unitCube(30));
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Eigen::Map<Eigen::Matrix3Xd> points(stream.positions.data(), 3, stream.vertices());
  points = (turn * points).eval();
  const Solved whole = measure(MemoryMesh(stream), wallOf());
  EXPECT_EQ(whole.report.passes, 1);
  DistanceOptions options;
  options.threads = 1;
  options.memoryLimit = whole.report.pool_bytes_peak - 400000;
  const Solved parts = measure(MemoryMesh(stream, 77), wallOf(), options);
  EXPECT_GT(parts.report.passes, 1);
  EXPECT_LE(parts.report.pool_bytes_peak, options.memoryLimit);
  EXPECT_TRUE(sameBits(parts.values, whole.values));
}

/** A wall between cells, stated for its faces: a plane through the cube, on both sides of which
 * distances are those from it. Of the two cells of a face, any may name it. */
TEST(WallDistance, FromFacesOfAGroupBetweenCells)
{
  StreamMesh stream = toStream(unitCube(6, 0.0));
  constexpr double plane = 2.0 / 6.0;
  std::vector<GroupSet> sets(stream.corners.size(), 0);
  std::set<std::vector<std::int64_t>> seen;
  for (std::size_t facet = 0; facet < sets.size(); ++facet)
  {
    const std::size_t cell = facet / 4 * 4;
    std::vector<std::int64_t> corners(stream.corners.begin() + static_cast<std::ptrdiff_t>(cell),
      stream.corners.begin() + static_cast<std::ptrdiff_t>(cell) + 4);
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(facet % 4));
    const bool isOnPlane = std::ranges::all_of(
      corners, [&](std::int64_t v) { return stream.positions[3 * v + 2] == plane; });
    std::ranges::sort(corners);
    sets[facet] = isOnPlane && seen.insert(corners).second ? 1 : 0;
  }
  stream.groups.groups = { { "baffle", {}, GroupOf::Facets } };
  stream.groups.sets = { {}, { 0 } };
  stream.cellColumns.push_back(makeColumn<GroupSet>(FacetGroupsName, sets, 4));
  const std::vector<Where> baffle{ InGroup{ { "baffle" } } };
  const Solved found = measure(MemoryMesh(stream), wallOf(baffle));
  EXPECT_EQ(found.report.distance->sources, std::ssize(seen));
  for (std::int64_t v = 0; v < stream.vertices(); ++v)
  {
    EXPECT_NEAR(found.values(v, 0), std::fabs(stream.positions[3 * v + 2] - plane), 1e-12);
  }
  // The same bits for any blocks; and together with the boundary the lesser of both.
  EXPECT_TRUE(sameBits(measure(MemoryMesh(stream, 3), wallOf(baffle)).values, found.values));
  const Solved boundary = measure(MemoryMesh(stream), wallOf());
  const Solved both = measure(MemoryMesh(stream), wallOf({ baffle[0], OnBoundary{} }));
  EXPECT_TRUE(sameBits(both.values.col(0), found.values.col(0).cwiseMin(boundary.values.col(0))));
}

TEST(WallDistance, HasErrors)
{
  expectError([] { measure(MemoryMesh(toStream(unitSquare(4))), wallOf()); },
    "distance to walls is that of a tetrahedral mesh");
  const MemoryMesh cube(toStream(unitCube(6)));
  expectError(
    [&] {
      measure(cube, wallOf({ Region(Region::Box{ { 0.3, 0.3, 0.3 }, { 0.7, 0.7, 0.7 } }) }));
    },
    "no face of the boundary or of a group of the mesh is wall");
  expectError(
    [&] {
      measure(cube, wallOf({ Region(Region::Sphere{ { 9, 9, 9 }, 1 }) }));
    },
    "from[0]: no face of the mesh is in this region");
  DistanceOptions options;
  options.memoryLimit = 1 << 19;
  const std::string sentence = messageOf([&] { measure(cube, wallOf(), options); });
  EXPECT_TRUE(contains(sentence, "a distance needs at least")) << sentence;
}

TEST(NearestPoint, OfSliversIsThatOfTheirEdgesAndPlane)
{
  Random random(11);
  for (int trial = 0; trial < 3000; ++trial)
  {
    // The third corner is near the line of the others, inside or outside of the edge.
    TrianglePoints triangle{};
    const double height = std::pow(10.0, random.uniform(-12, 0));
    const double along = random.uniform(-1, 2);
    double point[3];
    for (int k = 0; k < 3; ++k)
    {
      triangle.point[0][k] = random.uniform();
      triangle.point[1][k] = random.uniform();
      triangle.point[2][k] = triangle.point[0][k] +
                             along * (triangle.point[1][k] - triangle.point[0][k]) +
                             height * random.uniform(-1, 1);
      point[k] = random.uniform(-0.5, 1.5);
    }
    const Vector way = difference(nearestPoint(triangle, point).data(), point);
    EXPECT_NEAR(std::sqrt(dot(way, way)), distanceTo(triangle, point), 1e-12) << trial;
  }
}

TEST(TriangleTree, FindsTheFirstOfTheNearest)
{
  // Triangles of all sizes, some without area, many of them twice.
  Random random(3);
  std::vector<TrianglePoints> triangles(500);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const double size = std::pow(10.0, random.uniform(-4, 0));
    for (int k = 0; k < 9; ++k)
    {
      const double centre = triangles[t].point[0][k % 3];
      triangles[t].point[k / 3][k % 3] = k < 3 ? random.uniform()
                                         : t % 7 == 0 && k > 5
                                           ? triangles[t].point[1][k % 3]
                                           : centre + size * random.uniform(-1, 1);
    }
    if (t % 5 == 4)
    {
      triangles[t] = triangles[static_cast<std::size_t>(random.below(std::int64_t(t)))];
    }
  }
  Pool pool(1 << 20);
  const TriangleTree tree(pool, triangles);
  for (int trial = 0; trial < 500; ++trial)
  {
    const double point[3] = { random.uniform(-0.5, 1.5), random.uniform(-0.5, 1.5),
      random.uniform(-0.5, 1.5) };
    const double least = straightTo(triangles, point);
    const TriangleTree::Nearest nearest =
      tree.nearest(point, HUGE_VAL, trial % 2 ? random.below(500) : -1);
    EXPECT_DOUBLE_EQ(nearest.distance, least);
    const auto first = std::ranges::find_if(triangles,
      [&](const TrianglePoints& t)
      {
        const Vector way = difference(nearestPoint(t, point).data(), point);
        return std::sqrt(dot(way, way)) == nearest.distance;
      });
    EXPECT_EQ(nearest.triangle, first - triangles.begin());
    EXPECT_EQ(tree.nearest(point, 0.999 * least, -1).triangle, -1);
  }
}

} // namespace smg::testing
