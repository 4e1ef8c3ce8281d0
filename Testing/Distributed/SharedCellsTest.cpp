// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedElements.h"
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/EllipticTesting.h"

#include <gtest/gtest.h>

#include <algorithm>

// Cells that several processes have are counted, by their vertices.

namespace smg::testing
{
namespace
{

std::int64_t repeatedCellsOf(const MeshPart& part)
{
  Team team(MPI_COMM_WORLD);
  std::int64_t repeated = -1;
  team.run(
    [&]
    {
      const SharedVertices vertices(team, part);
      repeated = repeatedCells(vertices, part);
    });
  return repeated;
}

/** The part of this process with cells of others: `before` of those before its own ones, and
 * `after` of those behind them. */
MeshPart widerPart(const StreamMesh& mesh, std::int64_t before, std::int64_t after)
{
  const auto rank = static_cast<std::size_t>(rankOfTest());
  std::vector<std::int64_t> cuts = evenCuts(mesh.cells(), sizeOfTest());
  const MeshPart own = partOf(mesh, cuts);
  cuts[rank] = std::max<std::int64_t>(cuts[rank] - before, 0);
  cuts[rank + 1] = std::min(cuts[rank + 1] + after, mesh.cells());
  MeshPart part = partOf(mesh, cuts);
  part.firstOwned = own.firstOwned;
  part.endOwned = own.endOwned;
  return part;
}

} // namespace

TEST(SharedCells, AreNoneInAPartition)
{
  for (const StreamMesh& mesh : { patch(24, 21), block(6, 5, 4) })
  {
    EXPECT_EQ(repeatedCellsOf(widerPart(mesh, 0, 0)), 0);
  }
}

TEST(SharedCells, AreCountedOnceEach)
{
  const int borders = sizeOfTest() - 1;
  for (const StreamMesh& mesh : { patch(24, 21), block(6, 5, 4) })
  {
    EXPECT_EQ(repeatedCellsOf(widerPart(mesh, 3, 0)), 3 * borders);
    EXPECT_EQ(repeatedCellsOf(widerPart(mesh, 0, 2)), 2 * borders);
    EXPECT_EQ(repeatedCellsOf(widerPart(mesh, 3, 2)), 5 * borders);
    // Every process has all cells.
    EXPECT_EQ(
      repeatedCellsOf(widerPart(mesh, mesh.cells(), mesh.cells())), borders > 0 ? mesh.cells() : 0);
  }
}

TEST(SharedCells, MayHaveTheirCornersInAnyOrder)
{
  const StreamMesh mesh = block(6, 5, 4);
  MeshPart part = widerPart(mesh, 2, 0);
  const std::size_t corners = cornersOf(mesh.cellType);
  for (std::size_t c = 0; c < part.block.corners.size(); c += corners)
  {
    const auto first = part.block.corners.begin() + static_cast<std::ptrdiff_t>(c);
    std::rotate(first, first + rankOfTest() % 4, first + static_cast<std::ptrdiff_t>(corners));
  }
  EXPECT_EQ(repeatedCellsOf(part), 2 * (sizeOfTest() - 1));
}

TEST(SharedCells, AreNoneWithinAProcess)
{
  const StreamMesh mesh = patch(24, 21);
  MeshPart part = widerPart(mesh, 0, 0);
  std::vector<std::int64_t>& corners = part.block.corners;
  const std::vector<std::int64_t> first(corners.begin(), corners.begin() + 3);
  corners.insert(corners.end(), first.begin(), first.end());
  EXPECT_EQ(repeatedCellsOf(part), 0);
}

} // namespace smg::testing
