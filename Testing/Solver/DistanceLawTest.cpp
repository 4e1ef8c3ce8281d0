// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceSurfaces.h"
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Support/Refinement.h"

#include "Solver/Core/Vector.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

// Laws of distances on surfaces of random triangles, up to 1 : 10,000, flat, folded, in cones of
// any angle, with holes and in several bodies, from one and many points. Where the surface unfolds
// into the plane, exact distances are known without any method.

namespace smg::testing
{
namespace
{

/** The shortest paths along edges, by relaxing all edges until nothing changes. */
Eigen::VectorXd alongEdges(const StreamMesh& mesh, const std::vector<std::int64_t>& sources)
{
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(mesh.vertices(), HUGE_VAL);
  for (const std::int64_t source : sources)
  {
    distance[source] = 0;
  }
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    {
      const std::int64_t a = mesh.corners[c], b = mesh.corners[c % 3 == 2 ? c - 2 : c + 1];
      const double length = straightFrom(mesh, a)(mesh.positions.data() + 3 * b);
      for (const auto& [from, to] : { std::pair(a, b), std::pair(b, a) })
      {
        isChanged = isChanged || distance[from] + length < distance[to];
        distance[to] = std::min(distance[to], distance[from] + length);
      }
    }
  }
  return distance;
}

} // namespace

TEST(DistanceLaws, ExactOnesAreThoseOfTheUnfoldedSurface)
{
  for (const KnownSurface& surface : surfaces())
  {
    if (!surface.exact)
    {
      continue;
    }
    SCOPED_TRACE(surface.name);
    const MemoryMesh mesh(surface.mesh);
    Random random(11);
    for (int run = 0; run < 6; ++run)
    {
      const std::int64_t source = run == 0 ? 0 : random.below(surface.mesh.vertices());
      const Solved solved = measure(mesh, fromPoints({ source }, PathAccuracy::Exact));
      EXPECT_TRUE(solved.report.distance->exact);
      double worst = 0;
      for (std::int64_t v = 0; v < surface.mesh.vertices(); ++v)
      {
        const double exact = surface.exact(source, v);
        worst = std::max(worst, std::abs(solved.values(v, 0) - exact) / (exact + 1e-300));
      }
      EXPECT_LT(worst, 1e-9) << "from " << source;
    }
  }
}

TEST(DistanceLaws, ExactOnesAreSymmetric)
{
  for (const KnownSurface& surface : surfaces())
  {
    SCOPED_TRACE(surface.name);
    const MemoryMesh mesh(surface.mesh);
    Random random(13);
    std::vector<std::int64_t> ids = someVertices(surface.mesh, 5, random);
    std::vector<Eigen::VectorXd> from;
    for (const std::int64_t id : ids)
    {
      from.emplace_back(measure(mesh, fromPoints({ id }, PathAccuracy::Exact)).values.col(0));
    }
    for (std::size_t a = 0; a < ids.size(); ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        const double there = from[a][ids[b]], back = from[b][ids[a]];
        EXPECT_TRUE(there == back || std::abs(there - back) <= 1e-12 * there)
          << there << " and " << back;
      }
    }
  }
}

TEST(DistanceLaws, ThoseOfSeveralPointsAreTheLeastOfTheSingleOnes)
{
  for (const KnownSurface& surface : surfaces())
  {
    SCOPED_TRACE(surface.name);
    const MemoryMesh mesh(surface.mesh);
    Random random(17);
    const std::vector<std::int64_t> ids = someVertices(surface.mesh, 6, random);
    const Eigen::MatrixXd together = measure(mesh, fromPoints(ids, PathAccuracy::Exact)).values;
    Eigen::VectorXd least = Eigen::VectorXd::Constant(surface.mesh.vertices(), HUGE_VAL);
    Eigen::VectorXd ofSource = least;
    for (const std::int64_t id : ids)
    {
      const Eigen::VectorXd alone =
        measure(mesh, fromPoints({ id }, PathAccuracy::Exact)).values.col(0);
      least = least.cwiseMin(alone);
      for (Eigen::Index v = 0; v < alone.size(); ++v)
      {
        ofSource[v] = together(v, 1) == static_cast<double>(id) ? alone[v] : ofSource[v];
      }
    }
    for (Eigen::Index v = 0; v < least.size(); ++v)
    {
      const double found = together(v, 0);
      EXPECT_TRUE(found == least[v] || std::abs(found - least[v]) <= 1e-12 * least[v])
        << found << " instead of " << least[v];
      EXPECT_TRUE(found == ofSource[v] || std::abs(found - ofSource[v]) <= 1e-12 * found);
    }
  }
}

TEST(DistanceLaws, AllLieBetweenTheStraightLineAndTheEdges)
{
  for (const KnownSurface& surface : surfaces())
  {
    for (const PathAccuracy accuracy : { PathAccuracy::Exact, PathAccuracy::Approximate })
    {
      SCOPED_TRACE(surface.name + (accuracy == PathAccuracy::Exact ? ", exact" : ", approximate"));
      const MemoryMesh mesh(surface.mesh);
      const double slack = accuracy == PathAccuracy::Exact ? 1e-12 : 1e-6;
      for (const int count : { 0, 1, 8, 40 })
      {
        Random random(19);
        const std::vector<std::int64_t> ids = someVertices(surface.mesh, count, random);
        const Eigen::MatrixXd found = measure(mesh, fromPoints(ids, accuracy)).values;
        const Eigen::VectorXd edges = alongEdges(surface.mesh, ids);
        for (std::int64_t v = 0; v < surface.mesh.vertices(); ++v)
        {
          double line = HUGE_VAL;
          for (const std::int64_t id : ids)
          {
            line =
              std::min(line, straightFrom(surface.mesh, id)(surface.mesh.positions.data() + 3 * v));
          }
          const double distance = found(v, 0);
          EXPECT_TRUE(distance <= edges[v] * (1 + slack)) << distance << " > " << edges[v];
          EXPECT_TRUE(distance >= line * (1 - slack)) << distance << " < " << line;
          EXPECT_EQ(distance == HUGE_VAL, edges[v] == HUGE_VAL);
        }
      }
    }
  }
}

/** A vertex of a little more than a full turn leaves a gap behind it, which grows with the
 * distance: what lies in it is seen all the same. */
TEST(DistanceLaws, ExactOnesAreRightOnNearlyFlatSurfaces)
{
  constexpr int n = 40;
  for (const double noise : { 1e-9, 1e-7, 1e-6, 3e-6, 1e-5 })
  {
    IndexedTestMesh square = unitSquare(n, 0.2);
    Random random(5);
    for (std::size_t k = 2; k < square.positions.size(); k += 3)
    {
      square.positions[k] = random.uniform(-noise, noise) / n;
    }
    const MemoryMesh mesh(toStream(square));
    for (const std::int64_t source : { mesh.mesh().vertices() / 2, std::int64_t(40) })
    {
      const Eigen::VectorXd found =
        measure(mesh, fromPoints({ source }, PathAccuracy::Exact)).values.col(0);
      const auto straight = straightFrom(mesh.mesh(), source);
      for (Eigen::Index v = 0; v < found.size(); ++v)
      {
        const double line = straight(mesh.mesh().positions.data() + 3 * v);
        EXPECT_NEAR(found[v], line, (100 * noise * noise + 1e-11) * line) << noise;
      }
    }
  }
}

TEST(DistanceLaws, ExactOnesPassVerticesOfSeveralFans)
{
  // Two regular tetrahedra with one vertex in common, around which the angles add up to a full
  // turn: a path from one to the other goes through it, and there is no other one.
  IndexedTestMesh mesh;
  mesh.positions = { 0, 0, 0, 1, 1, 0, 1, 0, 1, 0, 1, 1, -1, -1, 0, -1, 0, -1, 0, -1, -1 };
  for (const std::int64_t first : { 1, 4 })
  {
    const std::int64_t a = first, b = first + 1, c = first + 2;
    mesh.corners.insert(mesh.corners.end(), { 0, a, b, 0, b, c, 0, c, a, a, c, b });
  }
  // Finer, so that paths to the tip do not all run along edges.
  mesh = refined(refined(mesh));
  const MemoryMesh stored(toStream(mesh));
  const StreamMesh& stream = stored.mesh();
  const std::int64_t tip = nearestTo(stream, 0, 0, 0);
  const Eigen::VectorXd fromTip =
    measure(stored, fromPoints({ tip }, PathAccuracy::Exact)).values.col(0);
  const std::int64_t source = nearestTo(stream, 0.75, 0.25, 0.5);
  const Eigen::VectorXd found =
    measure(stored, fromPoints({ source }, PathAccuracy::Exact)).values.col(0);
  for (std::int64_t v = 0; v < stream.vertices(); ++v)
  {
    const double* p = &stream.positions[3 * std::size_t(v)];
    if (p[0] + p[1] + p[2] < 0)
    {
      EXPECT_NEAR(found[v], fromTip[source] + fromTip[v], 1e-12);
    }
  }
}

/** Across a hub, each edge around it passes an interval of its own on from spoke to spoke. */
TEST(DistanceLaws, ExactOnesPassAHubOfManyTriangles)
{
  constexpr int n = 2000;
  IndexedTestMesh hub;
  hub.positions = { 0, 0, 0 };
  for (int ring = 1; ring <= 2; ++ring)
  {
    for (int k = 0; k < n; ++k)
    {
      const double angle = 2 * std::numbers::pi * k / n;
      hub.positions.insert(
        hub.positions.end(), { ring * std::cos(angle), ring * std::sin(angle), 0.0 });
      const std::int64_t a = 1 + (ring - 1) * n + k, b = 1 + (ring - 1) * n + (k + 1) % n;
      ring == 1 ? hub.corners.insert(hub.corners.end(), { 0, a, b })
                : hub.corners.insert(hub.corners.end(), { a - n, a, b, a - n, b, b - n });
    }
  }
  const MemoryMesh mesh(toStream(hub));
  const std::int64_t source = nearestTo(mesh.mesh(), 2, 0, 0);
  const Eigen::VectorXd found =
    measure(mesh, fromPoints({ source }, PathAccuracy::Exact)).values.col(0);
  const auto straight = straightFrom(mesh.mesh(), source);
  for (Eigen::Index v = 0; v < found.size(); v += 97)
  {
    const double line = straight(mesh.mesh().positions.data() + 3 * v);
    EXPECT_NEAR(found[v], line, 1e-9 * line);
  }
}

/** Between the vertices of a region, the edges of the mesh are sources, too; points beside it are
 * none of it. Approximate ones are at least the straight lines. */
TEST(DistanceLaws, OnesOfARegionAreThoseOfItsEdges)
{
  for (const double flatness : { 1.0, 20.0, 1000.0 })
  {
    const KnownSurface surface = flatSurface(flatness, 0.24);
    const StreamMesh& stream = surface.mesh;
    const MemoryMesh mesh(stream);
    const auto point = [&](std::int64_t v) { return &stream.positions[3 * std::size_t(v)]; };
    using Box = Region::Box;
    for (const Region& region : { Region(Region::Sphere{ { 0.4, 0.3 / flatness, 0 }, 0.2 }),
           Region(Box{ { 0.5, 0, -1 }, { 0.56, 1, 1 } }),
           Region(Box{ { 0.1, 0.2 / flatness, -1 }, { 0.8, 0.25 / flatness, 1 } }),
           Region(Region::HalfSpace{ { -1, 0, 0 }, 0 }) })
    {
      DistanceDescription description =
        fromPoints({ 5, stream.vertices() - 2 }, PathAccuracy::Exact);
      std::vector<bool> isSource(static_cast<std::size_t>(stream.vertices()));
      for (std::int64_t v = 0; v < stream.vertices(); ++v)
      {
        isSource[std::size_t(v)] = region.contains(std::span<const double, 3>(point(v), 3), v);
      }
      ASSERT_GT(std::ranges::count(isSource, true), 0);
      description.from.emplace_back(region);
      const Eigen::VectorXd found = measure(mesh, description).values.col(0);
      description.accuracy = PathAccuracy::Approximate;
      const Eigen::VectorXd approximate = measureInChunks(mesh, description, 200).values.col(0);
      for (std::int64_t v = 0; v < stream.vertices(); ++v)
      {
        const double* p = point(v);
        double least =
          std::min(straightFrom(stream, 5)(p), straightFrom(stream, stream.vertices() - 2)(p));
        for (std::size_t c = 0; c < stream.corners.size(); ++c)
        {
          const std::int64_t a = stream.corners[c];
          const std::int64_t b = stream.corners[c % 3 == 2 ? c - 2 : c + 1];
          if (!isSource[std::size_t(a)])
          {
            continue;
          }
          least = std::min(least, straightFrom(stream, a)(p));
          if (isSource[std::size_t(b)])
          {
            const Vector edge = difference(point(b), point(a)), to = difference(p, point(a));
            const double share = std::clamp(dot(edge, to) / dot(edge, edge), 0.0, 1.0);
            const Vector foot = scaled(share, edge);
            const Vector rest = difference(to.data(), foot.data());
            least = std::min(least, std::sqrt(dot(rest, rest)));
          }
        }
        // The triangles between three vertices of the region have no vertex inside.
        EXPECT_NEAR(found[v], least, 1e-9 * least + 1e-15) << flatness << ", vertex " << v;
        EXPECT_GE(approximate[v], (1 - 1e-12) * least) << flatness << ", vertex " << v;
      }
    }
  }
}

/** Chunks and windows cost work, but no accuracy. */
TEST(DistanceLaws, ExactOnesDoNotDependOnTheWindow)
{
  const KnownSurface surface = tornSurface(3, 80);
  const MemoryMesh mesh(surface.mesh);
  Random random(23);
  const DistanceDescription description =
    fromPoints(someVertices(surface.mesh, 4, random), PathAccuracy::Exact);
  const Eigen::VectorXd whole = measure(mesh, description).values.col(0);
  for (const std::int64_t chunk : { 1, 400, 1000 })
  {
    const Solved parts = measureInChunks(mesh, description, chunk);
    EXPECT_GT(parts.report.passes, chunk < 1000 ? 1 : 0);
    for (Eigen::Index v = 0; v < whole.size(); ++v)
    {
      const double found = parts.values(v, 0);
      EXPECT_TRUE(found == whole[v] || std::abs(found - whole[v]) <= 1e-12 * whole[v])
        << found << " instead of " << whole[v];
    }
  }
}

/** What is farther than wanted is not reached, and nothing else changes: exactly, or for
 * approximate ones but for what paths beyond would have improved. */
TEST(DistanceLaws, OnesWithinALengthAreThose)
{
  for (const KnownSurface& surface : surfaces())
  {
    for (const PathAccuracy accuracy : { PathAccuracy::Exact, PathAccuracy::Approximate })
    {
      SCOPED_TRACE(surface.name + (accuracy == PathAccuracy::Exact ? ", exact" : ", approximate"));
      const MemoryMesh mesh(surface.mesh);
      Random random(29);
      DistanceDescription description = fromPoints(someVertices(surface.mesh, 3, random), accuracy);
      description.source = description.direction = true;
      const Eigen::MatrixXd all = measure(mesh, description).values;
      std::vector<double> sorted(all.col(0).data(), all.col(0).data() + all.rows());
      std::ranges::sort(sorted);
      description.within = sorted[sorted.size() / 3];
      const double slack = accuracy == PathAccuracy::Exact ? 1e-12 : 1e-3;
      for (const std::int64_t chunk : { 100000, 300 })
      {
        const Eigen::MatrixXd near = measureInChunks(mesh, description, chunk).values;
        for (Eigen::Index v = 0; v < all.rows(); ++v)
        {
          const double distance = all(v, 0);
          if (std::abs(distance - description.within) <= slack * description.within)
          {
            continue; // on the border
          }
          if (distance > description.within)
          {
            EXPECT_EQ(near(v, 0), HUGE_VAL) << distance;
            EXPECT_EQ(near(v, 1), -1.0);
            EXPECT_EQ(near.row(v).tail<3>().norm(), 0.0);
            continue;
          }
          EXPECT_TRUE(std::abs(near(v, 0) - distance) <= slack * distance)
            << near(v, 0) << " instead of " << distance << " within " << description.within;
        }
      }
    }
  }
}

} // namespace smg::testing
