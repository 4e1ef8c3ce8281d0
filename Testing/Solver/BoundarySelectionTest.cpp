// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedProblem.h"

#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolveMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace smg::testing
{
namespace
{

/** The data of the problem with u = 1 on the boundary. */
ProblemAnswers answersOf(MemorySource& mesh, std::int64_t blockCells)
{
  ProblemDescription description;
  description.dirichlet = { { OnBoundary{}, 1.0 } };
  DescribedProblem problem(description, mesh.info(), "p.json");
  mesh.rewind(blockCells);
  problem.prepare(mesh);
  mesh.rewind(blockCells);
  return answersOf(problem, mesh);
}

/** Whether each vertex is on the boundary, whatever the blocks. */
std::vector<bool> isOnBoundary(const StreamMesh& mesh)
{
  MemorySource source(mesh);
  std::vector<bool> first;
  for (const std::int64_t blockCells : { 1, 7, 100000 })
  {
    std::vector<bool> boundary;
    for (const std::int32_t condition : answersOf(source, blockCells).vertices.dirichlet)
    {
      boundary.push_back(condition == 0);
    }
    EXPECT_TRUE(first.empty() || boundary == first);
    first = boundary;
  }
  return first;
}

/** A stream of cells in the order given, with vertices at random points. */
StreamMesh meshOf(CellType type, std::vector<std::int64_t> corners)
{
  IndexedTestMesh mesh{ type, {}, std::move(corners) };
  const auto vertices = *std::ranges::max_element(mesh.corners) + 1;
  Random random(3);
  mesh.positions.resize(static_cast<std::size_t>(3 * vertices));
  std::ranges::generate(mesh.positions, [&] { return random.uniform(); });
  return toStream(mesh, TestOrder::Keep);
}

} // namespace

TEST(BoundarySelection, OfASquareAreTheVerticesOfItsSides)
{
  const StreamMesh mesh = toStream(shuffled(grid(9, 6)));
  const std::vector<bool> boundary = isOnBoundary(mesh);
  EXPECT_EQ(std::ranges::count(boundary, true), 2 * (9 + 6) - 4);
  for (std::size_t v = 0; v < boundary.size(); ++v)
  {
    const double y = mesh.positions[3 * v + 1];
    const double side = std::sqrt(3.0) / 2.0;
    EXPECT_TRUE(boundary[v] || (y > 0.5 * side && y < 4.5 * side)) << v;
  }
}

TEST(BoundarySelection, OfABoxOfTetrahedraAreTheVerticesOfItsSides)
{
  const StreamMesh mesh = toStream(tetBox(5, 4, 6, 0.1));
  const std::vector<bool> boundary = isOnBoundary(mesh);
  const auto isOuter = [](double x, double most) { return x < 0.5 || x > most - 0.5; };
  for (std::size_t v = 0; v < boundary.size(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    EXPECT_EQ(boundary[v], isOuter(p[0], 4) || isOuter(p[1], 3) || isOuter(p[2], 5)) << v;
  }
}

TEST(BoundarySelection, AnEdgeOfThreeTrianglesIsNotOpen)
{
  // A closed tetrahedral surface with a fin on its edge 0-1.
  const StreamMesh mesh =
    meshOf(CellType::Triangle, { 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 0, 1, 4 });
  EXPECT_EQ(isOnBoundary(mesh), (std::vector<bool>{ true, true, false, false, true }));
}

TEST(BoundarySelection, CellsThatAreDuplicatesOrUseAVertexTwiceDoNotCount)
{
  StreamMesh mesh = meshOf(CellType::Tetrahedron, { 0, 1, 2, 3, 3, 2, 1, 0, 1, 1, 2, 3 });
  const std::vector<std::uint8_t> flags{ 0, DuplicateCell, DegenerateCell };
  mesh.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, flags) };
  EXPECT_EQ(isOnBoundary(mesh), std::vector<bool>(4, true));
  // Without the flag, the first two close each other.
  mesh.cellColumns.clear();
  MemorySource source(mesh);
  EXPECT_PRED_FORMAT2(
    ::testing::IsSubstring, "no vertex", messageOf([&] { answersOf(source, 100); }));
}

TEST(BoundarySelection, AClosedMeshHasNone)
{
  MemorySource source(toStream(torus(9, 6)));
  EXPECT_EQ(messageOf([&] { answersOf(source, 5); }),
    "p.json: dirichlet[0]: no vertex of the mesh is on a boundary: the mesh is closed.");
}

TEST(BoundarySelection, AFluxOnTheBoundaryIsAFluxEverywhere)
{
  MemorySource source(describedMesh());
  const auto solved = [&](const Where& where)
  {
    ProblemDescription description;
    description.screening = 2.0;
    description.flux = { { where, "one" } };
    DescribedProblem problem(description, source.info());
    source.rewind(7);
    problem.prepare(source);
    source.rewind(7);
    return solveMesh(source, problem, {}).values;
  };
  EXPECT_TRUE(sameBits(solved(OnBoundary{}), solved(smg::Everywhere{})));
}

TEST(BoundarySelection, CellsAreSelectedByTheirCorners)
{
  const StreamMesh mesh = toStream(grid(7, 7));
  MemorySource source(mesh);
  const std::vector<bool> boundary = isOnBoundary(mesh);
  ProblemDescription description;
  description.conductivity = { { OnBoundary{}, 5.0 } };
  DescribedProblem problem(description, source.info());
  source.rewind(4);
  problem.prepare(source);
  source.rewind(4);
  const ProblemAnswers answers = answersOf(problem, source);
  int selected = 0;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const bool all = boundary[static_cast<std::size_t>(mesh.corners[3 * c])] &&
                     boundary[static_cast<std::size_t>(mesh.corners[3 * c + 1])] &&
                     boundary[static_cast<std::size_t>(mesh.corners[3 * c + 2])];
    EXPECT_EQ(answers.weight[static_cast<std::size_t>(3 * c)], all ? 5.0 : 1.0);
    selected += all ? 1 : 0;
  }
  EXPECT_GT(selected, 0);
}

TEST(BoundarySelection, MustBePrepared)
{
  MemorySource source(toStream(grid(4, 4)));
  ProblemDescription description;
  description.dirichlet = { { OnBoundary{}, 1.0 } };
  DescribedProblem problem(description, source.info());
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "call DescribedProblem::prepare()",
    messageOf([&] { answersOf(problem, source); }));
}

} // namespace smg::testing
