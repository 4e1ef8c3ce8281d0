// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** The distances from each place by itself, a column per place. */
Eigen::MatrixXd alone(const MemoryMesh& mesh, DistanceDescription description)
{
  const std::vector<Where> places = description.from;
  description.group = description.source = false;
  Eigen::MatrixXd found(mesh.mesh().vertices(), static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    description.from = { places[k] };
    found.col(static_cast<Eigen::Index>(k)) = measure(mesh, description).values.col(0);
  }
  return found;
}

/** The error of approximate distances where the fronts of two sources meet. */
double longestEdge(const StreamMesh& mesh)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const Eigen::MatrixXd points = positionsOf(mesh);
  double longest = 0.0;
  for (std::size_t c = 0; c < mesh.corners.size(); c += corners)
  {
    for (std::size_t k = 1; k < corners; ++k)
    {
      longest = std::max(
        longest, (points.row(mesh.corners[c + k]) - points.row(mesh.corners[c + k - 1])).norm());
    }
  }
  return longest;
}

/** The group of each vertex is nearest to it, as far as the distances are right, and -1 exactly
 * where none is reached. The distances and the sources are those without groups, bit for bit. */
void expectNearest(const MemoryMesh& mesh, DistanceDescription description, double tolerance)
{
  description.source = true;
  const Solved plain = measure(mesh, description);
  description.group = true;
  const Solved found = measure(mesh, description);
  ASSERT_EQ(found.values.cols(), 3);
  EXPECT_TRUE(sameBits(found.values.leftCols(2), plain.values));
  const Eigen::MatrixXd single = alone(mesh, description);
  for (Eigen::Index v = 0; v < single.rows(); ++v)
  {
    const double least = single.row(v).minCoeff();
    const auto group = static_cast<Eigen::Index>(found.values(v, 2));
    ASSERT_EQ(group < 0, std::isinf(least)) << v;
    ASSERT_LT(group, single.cols()) << v;
    if (group >= 0)
    {
      EXPECT_LE(single(v, group), least + tolerance) << v;
      EXPECT_NEAR(found.values(v, 0), least, tolerance) << v;
    }
  }
  // Alone, a group is the same without sources.
  description.source = false;
  EXPECT_TRUE(sameBits(measure(mesh, description).values.rightCols(1), found.values.rightCols(1)));
}

/** A few places of a few random vertices each. */
std::vector<Where> randomPlaces(std::int64_t vertices, Random& random)
{
  std::vector<Where> places;
  for (std::int64_t k = 2 + random.below(5); k > 0; --k)
  {
    Region::Vertices ids;
    for (std::int64_t i = 1 + random.below(3); i > 0; --i)
    {
      ids.ids.push_back(random.below(vertices));
    }
    places.emplace_back(Region(ids));
  }
  return places;
}

} // namespace

TEST(DistanceGroup, IsTheNearestPlaceOnSurfaces)
{
  for (std::uint64_t seed = 0; seed < 12; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(seed);
    const IndexedTestMesh surface = seed % 3 == 0 ? torus(30, 20, 0.2, seed)
                                    : seed % 3 == 1
                                      ? grid(25, 20, 0.1, seed)
                                      : disjointUnion(sphere(3), grid(9, 9), { 5, 0, 0 });
    const MemoryMesh mesh(toStream(shuffled(surface, seed)));
    DistanceDescription description;
    description.from = randomPlaces(mesh.mesh().vertices() / 2, random);
    description.accuracy = PathAccuracy::Exact;
    expectNearest(mesh, description, 1e-9);
    description.accuracy = PathAccuracy::Approximate;
    expectNearest(mesh, description, longestEdge(mesh.mesh()));
    description.within = 2.0;
    description.accuracy = PathAccuracy::Exact;
    expectNearest(mesh, description, 1e-9);
  }
}

TEST(DistanceGroup, IsTheNearestPlaceInSolids)
{
  for (std::uint64_t seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(seed);
    const MemoryMesh mesh(toStream(tetBox(9, 8, 7, 0.15, seed)));
    DistanceDescription description;
    description.from = randomPlaces(mesh.mesh().vertices(), random);
    expectNearest(mesh, description, longestEdge(mesh.mesh()));
    // Walls, of which some have parts in common.
    description = {};
    description.wall = true;
    for (const double at : { 1.5, 3.5 })
    {
      description.from.emplace_back(Region(Region::HalfSpace{ { -1, 0, 0 }, -at }));
      description.from.emplace_back(Region(Region::HalfSpace{ { 0, 0, 1 }, at }));
    }
    expectNearest(mesh, description, 1e-12);
  }
}

TEST(DistanceGroup, OfWhatSeveralPlacesSelectIsTheFirst)
{
  const MemoryMesh mesh(toStream(grid(12, 9)));
  DistanceDescription description;
  description.group = true;
  description.from = { Region(Region::Vertices{ { 5, 7 } }),
    Region(Region::Vertices{ { 7, 50 } }) };
  const Solved found = measure(mesh, description);
  EXPECT_EQ(found.values(7, 1), 0.0);
  EXPECT_EQ(found.values(50, 1), 1.0);
  const std::vector<ColumnSpec> columns = distanceColumns(description);
  EXPECT_EQ(columns.at(1).name, DistanceGroupName);
  EXPECT_EQ(columns.at(1).type, ScalarType::Int32);
}

} // namespace smg::testing
