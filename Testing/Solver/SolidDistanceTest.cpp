// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/TriangleTree.h"
#include "Testing/Solver/DistanceTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

// Laws of distances through solids whose cells are flat up to 1 : 10,000: in convex ones they are
// straight lines, and around an edge they are known.

namespace smg::testing
{
namespace
{

/** The unit cube, without the quarter where x and y are above 1/2 if it has a `notch`; z divided by
 * `flatness`. Inner vertices are moved. */
StreamMesh solid(bool notch, double flatness)
{
  constexpr int n = 10;
  IndexedTestMesh mesh = tetBox(n + 1, n + 1, n + 1);
  const auto isCut = [&](double x, double y) { return notch && x > n / 2 && y > n / 2; };
  IndexedTestMesh kept;
  kept.cellType = mesh.cellType;
  std::vector<std::int64_t> place(mesh.positions.size() / 3, -1);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 4)
  {
    double middle[2] = { 0, 0 };
    for (std::size_t k = 0; k < 8; ++k)
    {
      const auto corner = 3 * static_cast<std::size_t>(mesh.corners[c + k / 2]);
      middle[k % 2] += mesh.positions[corner + k % 2] / 4;
    }
    for (std::size_t k = 0; k < 4 && !isCut(middle[0], middle[1]); ++k)
    {
      const auto corner = static_cast<std::size_t>(mesh.corners[c + k]);
      if (place[corner] < 0)
      {
        place[corner] = std::ssize(kept.positions) / 3;
        const auto begin = mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * corner);
        kept.positions.insert(kept.positions.end(), begin, begin + 3);
      }
      kept.corners.push_back(place[corner]);
    }
  }
  Random random(3);
  for (std::size_t k = 0; k < kept.positions.size(); k += 3)
  {
    double* const p = &kept.positions[k];
    const bool isOnNotch = notch && std::max(p[0], p[1]) >= n / 2 && std::min(p[0], p[1]) >= n / 2;
    const bool isInside =
      std::all_of(p, p + 3, [](double x) { return x > 0 && x < n; }) && !isOnNotch;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = (p[axis] + (isInside ? random.uniform(-0.2, 0.2) : 0.0)) / n;
    }
    p[2] /= flatness;
  }
  return toStream(kept);
}

/** The distance around the edge of the notch, x = y = 1/2. */
double aroundNotch(const double* a, const double* b)
{
  const double whole = std::hypot(a[0] - b[0], a[1] - b[1]);
  // On which side of the edge the line between passes it: the notch is to the right of the way from
  // large x to large y.
  const double *p = a[0] > b[0] ? a : b, *q = a[0] > b[0] ? b : a;
  const double side = (q[0] - p[0]) * (0.5 - p[1]) - (q[1] - p[1]) * (0.5 - p[0]);
  const bool isBlocked = p[0] > 0.5 && q[1] > 0.5 && side > 0;
  const double around = std::hypot(p[0] - 0.5, p[1] - 0.5) + std::hypot(q[0] - 0.5, q[1] - 0.5);
  return std::hypot(isBlocked ? around : whole, a[2] - b[2]);
}

/** The faces, edges and vertices of the cells that belong to a region of sources, and points. */
std::vector<TrianglePoints> facetsOf(
  const StreamMesh& mesh, const Region& region, const std::vector<std::int64_t>& points)
{
  std::vector<TrianglePoints> facets;
  const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c)
  {
    TrianglePoints& facet = facets.emplace_back();
    for (const auto& [k, v] : { std::pair(0, a), std::pair(1, b), std::pair(2, c) })
    {
      std::copy_n(&mesh.positions[3 * std::size_t(v)], 3, facet.point[k]);
    }
  };
  const auto isSource = [&](std::int64_t v) {
    return region.contains(std::span<const double, 3>(&mesh.positions[3 * std::size_t(v)], 3), v);
  };
  for (const std::int64_t v : points)
  {
    add(v, v, v);
  }
  for (std::size_t c = 0; c < mesh.corners.size(); c += 4)
  {
    std::vector<std::int64_t> sources;
    std::copy_if(mesh.corners.begin() + std::ptrdiff_t(c),
      mesh.corners.begin() + std::ptrdiff_t(c) + 4, std::back_inserter(sources), isSource);
    const std::size_t n = sources.size();
    for (std::size_t left = 0; left < (n == 4 ? n : 1) && n > 0; ++left)
    {
      const auto at = [&](std::size_t k) { return sources[(left + std::min(k, n - 1)) % n]; };
      add(at(0), at(1), at(2));
    }
  }
  return facets;
}

} // namespace

TEST(SolidDistances, AreStraightLinesInConvexSolidsWhateverTheCells)
{
  for (const double flatness : { 1.0, 10.0, 100.0, 10'000.0 })
  {
    const MemoryMesh mesh(solid(false, flatness));
    const StreamMesh& stream = mesh.mesh();
    Random random(7);
    for (const int count : { 1, 1, 5 })
    {
      std::vector<std::int64_t> sources;
      for (int k = 0; k < count; ++k)
      {
        sources.push_back(random.below(stream.vertices()));
      }
      for (const std::int64_t chunk : { 100000, 1 })
      {
        SCOPED_TRACE("1 : " + std::to_string(flatness) + ", " + std::to_string(count) +
                     " sources, chunks of " + std::to_string(chunk));
        const Solved found = measureInChunks(mesh, fromVertices(sources), chunk);
        for (std::int64_t v = 0; v < stream.vertices(); ++v)
        {
          double exact = HUGE_VAL;
          for (const std::int64_t source : sources)
          {
            exact =
              std::min(exact, straightFrom(stream, source)(&stream.positions[3 * std::size_t(v)]));
          }
          // A line that leaves the window is not seen.
          EXPECT_NEAR(found.values(v, 0), exact, (chunk == 1 ? 5e-3 : 1e-7) * exact) << v;
          EXPECT_GE(found.values(v, 0), (1 - 1e-7) * exact) << v;
        }
      }
    }
  }
}

/** The source that is named is one of the nearest, also where several are as near, and lines in the
 * boundary are seen, too. */
TEST(SolidDistances, OfSeveralPointsAreThoseOfTheSourcesThatTheyName)
{
  for (const double jitter : { 0.0, 0.1 })
  {
    const MemoryMesh mesh(toStream(unitCube(9, jitter)));
    const StreamMesh& stream = mesh.mesh();
    Random random(17);
    for (int run = 0; run < 8; ++run)
    {
      std::vector<std::int64_t> sources;
      for (int k = 0; k < 2 + run; ++k)
      {
        sources.push_back(random.below(stream.vertices()));
      }
      DistanceDescription description = fromVertices(sources);
      description.source = true;
      const Solved found = measure(mesh, description);
      for (std::int64_t v = 0; v < stream.vertices(); ++v)
      {
        const double* const p = &stream.positions[3 * std::size_t(v)];
        double least = HUGE_VAL;
        for (const std::int64_t source : sources)
        {
          least = std::min(least, straightFrom(stream, source)(p));
        }
        EXPECT_NEAR(found.values(v, 0), least, 1e-7);
        const auto named = static_cast<std::int64_t>(found.values(v, 1));
        EXPECT_NEAR(straightFrom(stream, named)(p), least, 1e-6) << v;
      }
    }
  }
}

/** Balls, slabs, boxes, a single vertex and a face, and points beside them. */
TEST(SolidDistances, OfRegionsAreStraightLinesInConvexSolidsWhateverTheCells)
{
  using Box = Region::Box;
  for (const double flatness : { 1.0, 10.0, 100.0, 10'000.0 })
  {
    const MemoryMesh mesh(solid(false, flatness));
    const StreamMesh& stream = mesh.mesh();
    const double z = 1 / flatness;
    for (const Region& region :
      { Region(Region::HalfSpace{ { -1, 0, 0 }, 0 }), Region(Region::HalfSpace{ { 1, 1, 0 }, 1.4 }),
        Region(Region::Sphere{ { 0.3, 0.4, 0.5 * z }, 0.27 }),
        Region(Box{ { 0.6, -1, -1 }, { 0.65, 2, 2 } }),
        Region(Box{ { -1, -1, -1 }, { 2, 2, 0.01 * z } }),
        Region(Box{ { 0.1, 0.1, 0.3 * z }, { 0.4, 0.5, 0.9 * z } }) })
    {
      for (const std::vector<std::int64_t>& points : { std::vector<std::int64_t>{}, { 17, 700 } })
      {
        DistanceDescription description =
          points.empty() ? DistanceDescription() : fromVertices(points);
        description.from.emplace_back(region);
        const std::vector<TrianglePoints> facets = facetsOf(stream, region, points);
        ASSERT_GT(facets.size(), points.size());
        std::vector<double> exact;
        for (std::int64_t v = 0; v < stream.vertices(); ++v)
        {
          exact.push_back(straightTo(facets, &stream.positions[3 * std::size_t(v)]));
        }
        for (const std::int64_t chunk : { 100000, 1 })
        {
          const Solved found = measureInChunks(mesh, description, chunk);
          for (std::int64_t v = 0; v < stream.vertices(); ++v)
          {
            EXPECT_NEAR(found.values(v, 0), exact[std::size_t(v)], 1e-6 * exact[std::size_t(v)])
              << "1 : " << flatness << ", chunks of " << chunk << ", vertex " << v;
          }
        }
      }
    }
  }
}

/** A source on the one side of a closed crack is not seen from the other side. */
TEST(SolidDistances, DoNotCrossAClosedCrack)
{
  constexpr int n = 8;
  IndexedTestMesh mesh = tetBox(n + 1, n + 1, n + 1);
  // Above the plane z = n / 2, the inner vertices of a square of it are others than below.
  const auto isCut = [&](const double* p)
  { return p[2] == n / 2 && std::abs(p[0] - n / 2) <= 2 && std::abs(p[1] - n / 2) <= 2; };
  std::vector<std::int64_t> copies(mesh.positions.size() / 3, -1);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 4)
  {
    double height = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      height += mesh.positions[3 * static_cast<std::size_t>(mesh.corners[c + k]) + 2] / 4;
    }
    for (std::size_t k = 0; k < 4 && height > n / 2; ++k)
    {
      const auto corner = static_cast<std::size_t>(mesh.corners[c + k]);
      const std::array<double, 3> p{ mesh.positions[3 * corner], mesh.positions[3 * corner + 1],
        mesh.positions[3 * corner + 2] };
      if (isCut(p.data()))
      {
        if (copies[corner] < 0)
        {
          copies[corner] = std::ssize(mesh.positions) / 3;
          mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
        }
        mesh.corners[c + k] = copies[corner];
      }
    }
  }
  const MemoryMesh stored(toStream(mesh));
  const StreamMesh& stream = stored.mesh();
  const std::int64_t below = nearestTo(stream, n / 2, n / 2, n / 2 - 0.01);
  std::vector<std::int64_t> sides;
  for (std::int64_t v = 0; v < stream.vertices(); ++v)
  {
    if (straightFrom(stream, below)(&stream.positions[3 * std::size_t(v)]) == 0)
    {
      sides.push_back(v);
    }
  }
  ASSERT_EQ(sides.size(), 2U);
  const Eigen::VectorXd fromOne = measure(stored, fromVertices({ sides[0] })).values.col(0);
  const Eigen::VectorXd fromOther = measure(stored, fromVertices({ sides[1] })).values.col(0);
  EXPECT_NEAR(fromOne[sides[1]], fromOther[sides[0]], 0.3);
  // There and back, past the nearest point that is not cut; approximately.
  EXPECT_GT(fromOne[sides[1]], 0.9 * 6.0);
  for (std::int64_t v = 0; v < stream.vertices(); ++v)
  {
    // From the centre below, what lies straight above the crack is seen around its border alone.
    const double* const p = &stream.positions[3 * std::size_t(v)];
    const bool isAbove = p[0] == n / 2 && p[1] == n / 2 && p[2] > n / 2;
    if (isAbove)
    {
      EXPECT_GT(std::max(fromOne[v], fromOther[v]), 0.9 * (3.0 + std::hypot(3.0, p[2] - n / 2)));
    }
  }
}

TEST(SolidDistances, AreNotShorterThanThePathAroundAnEdge)
{
  for (const double flatness : { 1.0, 10.0, 1000.0 })
  {
    const MemoryMesh mesh(solid(true, flatness));
    const StreamMesh& stream = mesh.mesh();
    Random random(11);
    for (int run = 0; run < 3; ++run)
    {
      const std::int64_t source = random.below(stream.vertices());
      const Solved found = measure(mesh, fromVertices({ source }));
      double mean = 0;
      for (std::int64_t v = 0; v < stream.vertices(); ++v)
      {
        const double exact = aroundNotch(
          &stream.positions[3 * std::size_t(source)], &stream.positions[3 * std::size_t(v)]);
        EXPECT_GE(found.values(v, 0), (1 - 1e-6) * exact) << v;
        mean += exact > 0 ? (found.values(v, 0) / exact - 1) / double(stream.vertices()) : 0.0;
      }
      EXPECT_LT(mean, 0.01) << "1 : " << flatness;
    }
  }
}

/** The same of a face that is seen by a part of the solid. */
TEST(SolidDistances, OfAFaceAreNotMuchShorterThanThePathAroundAnEdge)
{
  for (const double flatness : { 1.0, 10.0, 1000.0 })
  {
    const MemoryMesh mesh(solid(true, flatness));
    const StreamMesh& stream = mesh.mesh();
    DistanceDescription description;
    description.from.emplace_back(Region(Region::HalfSpace{ { 1, 0, 0 }, 1 }));
    const Solved found = measure(mesh, description);
    double mean = 0;
    for (std::int64_t v = 0; v < stream.vertices(); ++v)
    {
      const double* const p = &stream.positions[3 * std::size_t(v)];
      const double beside[3] = { 1, std::min(p[1], 0.5), p[2] };
      const double exact = aroundNotch(p, beside);
      EXPECT_GE(found.values(v, 0), (p[1] > 0.5 ? 0.97 : 1 - 1e-9) * exact) << v;
      EXPECT_LE(found.values(v, 0), (p[1] > 0.5 ? 1.08 : 1.02) * exact) << v;
      mean +=
        exact > 0 ? std::abs(found.values(v, 0) / exact - 1) / double(stream.vertices()) : 0.0;
    }
    EXPECT_LT(mean, 0.015) << "1 : " << flatness;
  }
}

} // namespace smg::testing
