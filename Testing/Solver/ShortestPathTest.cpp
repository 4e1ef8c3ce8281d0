// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceSurfaces.h"
#include "Testing/Solver/PathTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// Laws of shortest paths: on random surfaces, from points and regions, whatever the window.

namespace smg::testing
{
namespace
{

IndexedTestMesh twoSquares()
{
  IndexedTestMesh squares;
  for (const double z : { 0.0, 1.0 })
  {
    squares.positions.insert(squares.positions.end(), { 0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z });
    const std::int64_t first = z > 0.0 ? 4 : 0;
    squares.corners.insert(
      squares.corners.end(), { first, first + 1, first + 2, first, first + 2, first + 3 });
  }
  return squares;
}

} // namespace

TEST(ShortestPaths, AreOnTheSurfaceAndAsLongAsTheDistance)
{
  for (const KnownSurface& surface : surfaces())
  {
    const MemoryMesh mesh(surface.mesh);
    for (const int count : { 0, 1, 8 })
    {
      Random random(31);
      DistanceDescription description =
        fromPoints(someVertices(surface.mesh, count, random), PathAccuracy::Automatic);
      if (count == 8)
      {
        const double* const p = &surface.mesh.positions[300];
        description.from.emplace_back(Region(Region::Sphere{ { p[0], p[1], p[2] }, 0.2 }));
      }
      description.to = { Region(Region::Vertices{ someVertices(surface.mesh, 40, random) }) };
      for (const std::int64_t chunk : { 100000, 150 })
      {
        SCOPED_TRACE(surface.name + ", " + std::to_string(count) + " sources, chunks of " +
                     std::to_string(chunk));
        const Solved solved = measureInChunks(mesh, description, chunk);
        EXPECT_GE(solved.report.distance->paths.size(), 30U);
        checkPaths(surface.mesh, solved);
      }
    }
  }
}

/** Two squares apart from each other. */
TEST(ShortestPaths, ThatAreMissingAreNamed)
{
  const MemoryMesh mesh(toStream(twoSquares()));
  const auto notes = [&](const std::vector<std::int64_t>& ends, double within)
  {
    DistanceDescription description = fromPoints({ 0 }, PathAccuracy::Exact);
    description.to = { Region(Region::Vertices{ ends }) };
    description.within = within;
    return measure(mesh, description).report.notes;
  };
  using Notes = std::vector<std::string>;
  EXPECT_EQ(notes({ 1, 2 }, HUGE_VAL), Notes());
  EXPECT_EQ(
    notes({ 1, 5 }, HUGE_VAL), Notes({ "There is no path to vertex 5: no source reaches it." }));
  EXPECT_EQ(notes({ 1, 7, 5 }, HUGE_VAL),
    Notes({ "There are no paths to vertices 5, 7: no source reaches them." }));
  EXPECT_EQ(notes({ 1 }, 0.25),
    Notes({ "There is no path to vertex 1: no source reaches it within a distance of 0.25." }));
}

/** Where three pages meet, the path goes on in the page that leads to the source, however near to
 * it the corners of the others are. */
TEST(ShortestPaths, PassAnEdgeOfThreeTriangles)
{
  IndexedTestMesh book;
  constexpr int n = 4;
  for (int k = 0; k <= n; ++k)
  {
    const double y = k;
    // The spine, the pages of the source and of the end, and a narrow one.
    book.positions.insert(book.positions.end(), { 0, y, 0, -2, y, 0, 2, y, 0, 0, y + 0.3, 0.1 });
    for (const std::int64_t page : { 1, 2, 3 })
    {
      const std::int64_t a = 4 * k, b = a + 4;
      if (k < n)
      {
        book.corners.insert(book.corners.end(), { a, a + page, b + page, a, b + page, b });
      }
    }
  }
  const MemoryMesh mesh(toStream(book));
  const StreamMesh& stream = mesh.mesh();
  for (int from = 0; from <= n; ++from)
  {
    DistanceDescription description =
      fromPoints({ nearestTo(stream, -2, from, 0) }, PathAccuracy::Exact);
    std::vector<std::int64_t> ends;
    for (int to = 0; to <= n; ++to)
    {
      ends.push_back(nearestTo(stream, 2, to, 0));
    }
    description.to = { Region(Region::Vertices{ ends }) };
    const Solved solved = measure(mesh, description);
    EXPECT_EQ(solved.report.notes.size(), 0U);
    checkPaths(stream, solved);
  }
}

} // namespace smg::testing
