// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Solver/PathTesting.h"
#include "Testing/Solver/StitchedSurface.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Exact distances and paths where triangles without area stitch a surface together, and where more
// than two triangles meet at an edge: those of the same surface without the stitches.

namespace smg::testing
{
namespace
{

enum class Kind
{
  Flat,
  Curved,
  Torn,
  Finned
};
constexpr std::array<Kind, 4> Kinds{ Kind::Flat, Kind::Curved, Kind::Torn, Kind::Finned };

/** A small surface whose coordinates have few digits: points that are cut into its edges are on
 * them without rounding. */
IndexedTestMesh roundSurface(Kind kind, Random& random)
{
  IndexedTestMesh mesh = unitSquare(3 + static_cast<int>(random.below(3)), 0.0);
  const double noise = random.below(3) == 0 ? 0.0 : 0.08;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k)
  {
    const bool isHeight = k % 3 == 2;
    double& x = mesh.positions[k];
    const double bump = kind == Kind::Flat ? 0.0 : random.uniform(-0.15, 0.15);
    x = std::round(1024 * (isHeight ? bump : x + random.uniform(-noise, noise))) / 1024;
  }
  if (kind == Kind::Torn)
  {
    std::vector<std::int64_t> kept;
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    {
      if (random.below(5) > 0)
      {
        kept.insert(kept.end(), &mesh.corners[c], &mesh.corners[c] + 3);
      }
    }
    mesh.corners = std::move(kept);
  }
  const std::size_t corners = mesh.corners.size();
  for (int fin = 0; kind == Kind::Finned && fin < 5; ++fin)
  {
    const auto c = static_cast<std::size_t>(random.below(std::int64_t(corners)));
    const std::int64_t a = mesh.corners[c], b = mesh.corners[c % 3 == 2 ? c - 2 : c + 1];
    const std::int64_t tip = mesh.vertices();
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double middle =
        0.5 * (mesh.positions[3 * std::size_t(a) + k] + mesh.positions[3 * std::size_t(b) + k]);
      const double way = random.uniform(-0.1, 0.1) + (k == 2 ? 0.2 : 0.0);
      mesh.positions.push_back(std::round(1024 * (middle + way)) / 1024);
    }
    mesh.corners.insert(mesh.corners.end(), { a, b, tip });
  }
  return mesh;
}

/** Turns both meshes of a surface: triangles have no area but for rounding. */
void turn(StitchedSurface& surface, Random& random)
{
  const Eigen::Matrix3d frame = Eigen::Quaterniond(
    random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
                                  .normalized()
                                  .toRotationMatrix();
  for (IndexedTestMesh* const mesh : { &surface.stitched, &surface.plain })
  {
    for (std::size_t k = 0; k < mesh->positions.size(); k += 3)
    {
      Eigen::Vector3d::Map(&mesh->positions[k]) =
        frame * Eigen::Vector3d(Eigen::Vector3d::Map(&mesh->positions[k]));
    }
  }
}

StitchedSurface randomSurface(std::uint64_t seed, int most)
{
  Random random(seed);
  StitchedSurface surface(roundSurface(Kinds[seed % Kinds.size()], random));
  for (std::int64_t cuts = most > 0 ? 1 + random.below(most) : 0; cuts > 0; --cuts)
  {
    surface.cut(random);
  }
  if (random.below(2) == 0)
  {
    turn(surface, random);
  }
  return surface;
}

/** A mesh in stream order, where `sources` of the first mesh are marked as a region, or are points;
 * numbers of the stream. */
struct Measured
{
  Measured(const IndexedTestMesh& mesh, const std::vector<std::int64_t>& sources, bool isRegion)
    : stream(toStream(mesh))
    , ofNumber(static_cast<std::size_t>(mesh.vertices()), -1)
  {
    DistanceDescription description;
    std::vector<double> mask(stream.originalIds.size(), 0.0);
    std::vector<std::int64_t> all, points;
    for (std::int64_t v = 0; v < stream.vertices(); ++v)
    {
      const std::int64_t number = stream.originalIds[std::size_t(v)];
      ofNumber[std::size_t(number)] = v;
      all.push_back(v);
      if (std::ranges::find(sources, number) != sources.end())
      {
        mask[std::size_t(v)] = 1.0;
        points.push_back(v);
      }
    }
    stream.vertexColumns.push_back(makeColumn<double>("region", mask));
    description.from = { isRegion ? Where(ColumnMask{ "region" })
                                  : Where(Region(Region::Vertices{ points })) };
    description.to = { Region(Region::Vertices{ all }) };
    description.accuracy = PathAccuracy::Exact;
    description.source = true;
    solved = measure(MemoryMesh(stream), description);
  }
  /** The distance of a vertex of the first mesh; infinite if no triangle has it. */
  double of(std::int64_t number) const
  {
    const std::int64_t v = this->ofNumber[static_cast<std::size_t>(number)];
    return v < 0 ? HUGE_VAL : this->solved.values(v, 0);
  }

  StreamMesh stream;
  std::vector<std::int64_t> ofNumber;
  Solved solved;
};

/** Compares the distances of both meshes of a surface, and checks the paths. */
void expectSame(
  const StitchedSurface& surface, const std::vector<std::int64_t>& sources, bool isRegion)
{
  std::vector<std::int64_t> same;
  for (const std::int64_t v : sources)
  {
    same.push_back(surface.same[static_cast<std::size_t>(v)]);
  }
  const Measured found(surface.stitched, sources, isRegion), known(surface.plain, same, isRegion);
  for (std::int64_t v = 0; v < surface.stitched.vertices(); ++v)
  {
    const double one = found.of(v), other = known.of(surface.same[static_cast<std::size_t>(v)]);
    EXPECT_TRUE(one == other || std::abs(one - other) <= 1e-9)
      << one << " instead of " << other << " to " << v << " from " << sources[0];
  }
  EXPECT_EQ(found.solved.report.distance->paths.size(), std::size_t(found.stream.vertices()));
  checkPaths(found.stream, found.solved);
  checkPaths(known.stream, known.solved);
}

} // namespace

TEST(StitchedDistances, FromPointsAreThoseWithoutStitches)
{
  for (std::uint64_t seed = 1; seed <= 160; ++seed)
  {
    SCOPED_TRACE("surface " + std::to_string(seed));
    const StitchedSurface surface = randomSurface(seed, 14);
    Random random(seed);
    const std::int64_t count = surface.stitched.vertices();
    for (int run = 0; run < 6; ++run)
    {
      // The last vertices are those that have been cut into edges.
      const std::int64_t v = run < 4 ? count - 1 - 2 * run : random.below(count);
      if (!surface.faces[static_cast<std::size_t>(v)].empty())
      {
        expectSame(surface, { v }, false);
      }
    }
  }
}

/** From a triangle, or an edge, of the surface before it was cut. */
TEST(StitchedDistances, FromRegionsAreThoseWithoutStitches)
{
  for (std::uint64_t seed = 1; seed <= 160; ++seed)
  {
    const StitchedSurface surface = randomSurface(seed, 14);
    Random random(seed);
    for (int run = 0; run < 4; ++run)
    {
      SCOPED_TRACE("surface " + std::to_string(seed));
      const auto v = static_cast<std::size_t>(random.below(surface.stitched.vertices()));
      std::set<std::size_t> region = surface.faces[v];
      if (region.size() > 3)
      {
        region = { *region.begin() };
      }
      std::vector<std::int64_t> sources;
      for (std::size_t w = 0; w < surface.faces.size(); ++w)
      {
        if (std::ranges::includes(surface.faces[w], region))
        {
          sources.push_back(static_cast<std::int64_t>(w));
        }
      }
      if (!sources.empty() && !region.empty())
      {
        expectSame(surface, sources, true);
      }
    }
  }
}

/** Random vertices as a region, whose edges send straight fronts into all triangles: a path ends at
 * the front that has reached it, not at the end of another page. */
TEST(StitchedDistances, PathsFromRegionsPassEdgesOfSeveralTriangles)
{
  for (std::uint64_t seed = 3; seed <= 1200; seed += 4)
  {
    SCOPED_TRACE("surface " + std::to_string(seed));
    const StitchedSurface surface = randomSurface(seed, 0);
    Random random(seed);
    std::vector<std::int64_t> sources{ 0 };
    for (std::int64_t v = 1; v < surface.plain.vertices(); ++v)
    {
      if (random.below(5) == 0)
      {
        sources.push_back(v);
      }
    }
    const Measured found(surface.plain, sources, true);
    checkPaths(found.stream, found.solved);
  }
}

/** The distance from an edge is that from many points of it. */
TEST(StitchedDistances, FromAnEdgeAreThoseFromItsPoints)
{
  for (std::uint64_t seed = 3; seed <= 320; seed += 4)
  {
    SCOPED_TRACE("surface " + std::to_string(seed));
    constexpr int Parts = 32;
    StitchedSurface surface = randomSurface(seed, 0);
    Random random(seed);
    const std::vector<std::int64_t>& corners = surface.stitched.corners;
    const auto c = static_cast<std::size_t>(random.below(std::ssize(corners)));
    const std::int64_t a = corners[c], b = corners[c % 3 == 2 ? c - 2 : c + 1];
    const Measured edge(surface.stitched, { a, b }, true);
    checkPaths(edge.stream, edge.solved);
    std::vector<std::int64_t> points{ a, b };
    for (int k = 1; k < Parts; ++k)
    {
      points.push_back(surface.place(
        StitchedSurface::between(surface.pointOf(a), surface.pointOf(b), double(k) / Parts)));
    }
    const Measured fromPoints(surface.plain, points, false);
    const auto &p = surface.pointOf(a), &q = surface.pointOf(b);
    const double half = 0.5 * std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) / Parts;
    for (std::int64_t v = 0; v < surface.stitched.vertices(); ++v)
    {
      EXPECT_LE(edge.of(v), fromPoints.of(v) + 1e-12);
      EXPECT_GE(edge.of(v), fromPoints.of(v) - half) << "to " << v;
    }
  }
}

} // namespace smg::testing
