// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/PointTree.h"
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/DescribedProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace smg::testing
{
namespace
{

/** The first of the vertices nearest to a point, by comparison with all of them. */
std::int64_t firstNearest(const StreamMesh& mesh, const std::array<double, 3>& point)
{
  std::int64_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double distance =
      PointTree::squaredDistance(std::span<const double, 3>(&mesh.positions[3 * v], 3), point);
    nearest = distance < least ? v : nearest;
    least = std::min(least, distance);
  }
  return nearest;
}

} // namespace

/** More points than vertices in a batch; many are equally near to several vertices, or far outside.
 */
TEST(NearestSelection, OfManyPointsFindsTheFirstNearestVertices)
{
  const StreamMesh mesh = toStream(shuffled(grid(110, 100, 0.0)));
  NearestVertices places;
  Random random(5);
  for (int k = 0; k < 9000; ++k)
  {
    // Half integers are as near to two or four vertices.
    const auto at = [&](double size) { return std::round(random.uniform() * 2.0 * size) / 2.0; };
    places.points.push_back({ at(130.0) - 10.0, at(120.0) - 10.0, at(8.0) });
  }
  std::set<std::int64_t> expected;
  for (const std::array<double, 3>& point : places.points)
  {
    expected.insert(firstNearest(mesh, point));
  }
  for (const std::int64_t blockCells : { 500, 1000000 })
  {
    ProblemDescription description;
    description.dirichlet = { { places, 1.0 } };
    MemorySource source(mesh);
    source.rewind(blockCells);
    DescribedProblem problem(description, source.info(), "p.json");
    problem.prepare(source);
    source.rewind(blockCells);
    const ProblemAnswers answers = answersOf(problem, source);
    std::set<std::int64_t> selected;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      if (answers.vertices.dirichlet[static_cast<std::size_t>(v)] == 0)
      {
        selected.insert(v);
      }
    }
    EXPECT_EQ(selected, expected) << blockCells;
  }
}

/** A vertex has no whole cell, and none is known before the place is: the solve refuses it. */
TEST(NearestSelection, OfCellsThatHasNoneIsRefused)
{
  const StreamMesh mesh = toStream(tetBox(5, 5, 5));
  const Region inside = Region::Sphere{ { 2, 2, 2 }, 1.5 };
  const NearestVertices nearest{ { { 2.0, 2.0, 2.0 } } };
  for (const Where& place :
    { Where(nearest), Where(Combination{ Combination::Kind::All, { OnBoundary{}, inside } }),
      Where(Combination{ Combination::Kind::Any, { nearest } }) })
  {
    for (const std::int64_t blockCells : { 3, 1000000 })
    {
      ProblemDescription description;
      description.dirichlet = { { OnBoundary{}, 1.0 } };
      description.conductivity = { { Everywhere{}, 1.0 }, { place, 2.0 } };
      MemorySource source(mesh, blockCells);
      DescribedProblem problem(description, source.info(), "p.json");
      problem.prepare(source);
      source.rewind(blockCells);
      EXPECT_EQ(messageOf([&] { solveMesh(source, problem, {}); }),
        "p.json: conductivity[1]: no cell of the mesh has all its corners in this place.");
      problem.acceptEmpty();
      source.rewind(blockCells);
      EXPECT_EQ(messageOf([&] { solveMesh(source, problem, {}); }), "");
    }
  }
}

} // namespace smg::testing
