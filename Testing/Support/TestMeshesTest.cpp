// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/CellWeights.h"
#include "Testing/Support/Isosurface.h"
#include "Testing/Support/MemorySource.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

namespace smg::testing
{
namespace
{

double totalSize(const IndexedTestMesh& mesh)
{
  double sum = 0;
  const int size = cornersOf(mesh.cellType);
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    std::array<const double*, 4> points{};
    for (int k = 0; k < size; ++k)
    {
      points[k] = &mesh.positions[3 * mesh.corners[size * c + k]];
    }
    sum += cellWeights(mesh.cellType, points).size;
  }
  return sum;
}

/** V - E + F of triangles; fails if an edge is used twice in the same direction. */
std::int64_t eulerNumber(const IndexedTestMesh& mesh)
{
  std::set<std::pair<std::int64_t, std::int64_t>> directed;
  std::set<std::pair<std::int64_t, std::int64_t>> edges;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int64_t a = mesh.corners[3 * c + k];
      const std::int64_t b = mesh.corners[3 * c + (k + 1) % 3];
      EXPECT_TRUE(directed.emplace(a, b).second);
      edges.insert(std::minmax(a, b));
    }
  }
  return mesh.vertices() - static_cast<std::int64_t>(edges.size()) + mesh.cells();
}

} // namespace

TEST(TestMeshes, AreWhatTheySay)
{
  EXPECT_EQ(eulerNumber(grid(7, 5)), 1);
  EXPECT_EQ(eulerNumber(torus(9, 7)), 0);
  EXPECT_EQ(eulerNumber(sphere(2)), 2);
  EXPECT_EQ(sphere(2).vertices(), 162);
  EXPECT_LT(eulerNumber(noisyGyroid(24, 0.0)), 0) << "it has handles";
  EXPECT_NEAR(totalSize(sphere(4)), 4 * std::numbers::pi, 0.05);
  EXPECT_NEAR(totalSize(tetBox(4, 3, 5)), 3 * 2 * 4, 1e-12);
  EXPECT_EQ(eulerNumber(disjointUnion(torus(5, 5), sphere(0), { 9, 0, 0 })), 2);
}

TEST(TestMeshes, CellsAreOriented)
{
  const IndexedTestMesh box = tetBox(4, 4, 4, 0.15);
  for (std::int64_t c = 0; c < box.cells(); ++c)
  {
    const auto p = [&](int corner, int k)
    {
      return box.positions[3 * box.corners[4 * c + corner] + k] -
             box.positions[3 * box.corners[4 * c] + k];
    };
    const double volume = p(1, 0) * (p(2, 1) * p(3, 2) - p(2, 2) * p(3, 1)) -
                          p(1, 1) * (p(2, 0) * p(3, 2) - p(2, 2) * p(3, 0)) +
                          p(1, 2) * (p(2, 0) * p(3, 1) - p(2, 1) * p(3, 0));
    EXPECT_GT(volume, 0.0);
  }
}

TEST(TestMeshes, ShufflingKeepsTheMesh)
{
  const IndexedTestMesh mesh = torus(12, 8, 0.3);
  const IndexedTestMesh other = shuffled(mesh, 7);
  EXPECT_NE(mesh.corners, other.corners);
  EXPECT_EQ(eulerNumber(other), 0);
  EXPECT_NEAR(totalSize(mesh), totalSize(other), 1e-10);
}

TEST(MemorySource, DeliversACompactStreamInBlocksOfAnySize)
{
  const StreamMesh mesh = toStream(shuffled(torus(40, 20)));
  for (const std::int64_t blockCells : { 1, 7, 100, 100000 })
  {
    MemorySource source(mesh, blockCells);
    std::map<std::int64_t, std::int64_t> lastCell;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    {
      lastCell[mesh.corners[i]] = static_cast<std::int64_t>(i / 3);
    }
    std::int64_t vertices = 0;
    std::int64_t cells = 0;
    MeshBlock block;
    while (source.next(block))
    {
      EXPECT_EQ(block.firstVertex, vertices);
      EXPECT_EQ(block.firstCell, cells);
      vertices += block.vertices();
      cells += static_cast<std::int64_t>(block.corners.size() / 3);
      for (const std::int64_t corner : block.corners)
      {
        EXPECT_LT(corner, vertices);
      }
      ASSERT_LE(block.finalized, vertices);
      EXPECT_TRUE(block.finalized == 0 || lastCell[block.finalized - 1] < cells);
      EXPECT_TRUE(block.finalized == vertices || lastCell[block.finalized] >= cells);
    }
    EXPECT_EQ(vertices, 800);
    EXPECT_EQ(cells, 1600);
    EXPECT_EQ(block.finalized, 800);
    source.rewind(13);
    EXPECT_EQ(collect(source).corners, mesh.corners);
  }
}

TEST(MemorySource, BreadthFirstOrderIsNarrow)
{
  const IndexedTestMesh mesh = shuffled(grid(60, 60));
  const StreamInfo kept = MemorySource(toStream(mesh, TestOrder::Keep)).info();
  const StreamInfo sorted = MemorySource(toStream(mesh)).info();
  EXPECT_GT(kept.width, 1000);
  EXPECT_LT(sorted.width, 300);
  EXPECT_LT(sorted.span, 300);
  EXPECT_EQ(sorted.bounds[5], 0.0);
  EXPECT_EQ(sorted.vertices, 3600);
}

} // namespace smg::testing
