// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/RingWindow.h"

#include "Testing/Solver/ProjectionTesting.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

using Centers = std::vector<std::int64_t>;

/** Reads the mesh with a window that discards as much as possible after every block. */
RingWindow windowOf(
  const StreamMesh& mesh, int rings, const Centers& centers, std::int64_t blockCells)
{
  MemorySource source(mesh, blockCells);
  RingWindow window(mesh.cellType, rings);
  MeshBlock block;
  std::int64_t came = 0;
  while (source.next(block))
  {
    window.add(block);
    came += block.vertices();
    Centers present;
    for (const std::int64_t center : centers)
    {
      if (center < came)
      {
        present.push_back(center);
      }
    }
    window.forget(present);
  }
  window.finish();
  window.forget(centers);
  return window;
}

} // namespace

TEST(RingWindow, ForgetsWhatNoRingCanNeed)
{
  const StreamMesh mesh = toStream(torus(3000, 40, 0.2));
  MemorySource source(mesh, 1000);
  RingWindow window(mesh.cellType, 2);
  MeshBlock block;
  while (source.next(block))
  {
    window.add(block);
    window.forget({});
    // Both fronts of the breadth-first search are active, with two rings behind each.
    EXPECT_LT(window.cells(), 3000);
  }
  EXPECT_EQ(source.info().cells, 240000);
  window.finish();
  window.forget({});
  EXPECT_EQ(window.cells(), 0);
  EXPECT_EQ(window.bytes(), 0);
}

TEST(RingWindow, KeepsTheRingsOfItsCenters)
{
  Combinations chosen;
  const StreamMesh surface = toStream(torus(60, 40, 0.2));
  const StreamMesh volume = toStream(shuffled(tetBox(9, 10, 11, 0.1)));
  for (const StreamMesh* mesh : { &surface, &volume })
  {
    for (const std::int64_t blockCells : { 1, 50, 3000 })
    {
      for (const int rings : { 1, 2, 4 })
      {
        if (!chosen.next())
        {
          continue;
        }
        const std::int64_t center = mesh->vertices() / 3;
        Progress none;
        const auto found =
          windowOf(*mesh, rings, { center }, blockCells).nearestCenters(Centers{ center }, none);
        Indices vertices;
        for (const auto& [vertex, by] : found)
        {
          EXPECT_EQ(by, 0);
          vertices.insert(vertex);
        }
        EXPECT_EQ(vertices, ringsOf(*mesh, center, rings));
      }
    }
  }
}

TEST(RingWindow, CentersMayChange)
{
  // As for a vertex that is nearer to a point than the previous ones.
  const StreamMesh mesh = toStream(grid(40, 40));
  MemorySource source(mesh, 20);
  RingWindow window(mesh.cellType, 3);
  MeshBlock block;
  std::int64_t came = 0;
  while (source.next(block))
  {
    window.add(block);
    came += block.vertices();
    window.forget(Centers{ came - 1 });
    EXPECT_LT(window.cells(), 1200);
  }
  window.finish();
  const Centers centers{ came - 1 };
  window.forget(centers);
  const Indices expected = ringsOf(mesh, centers[0], 3);
  EXPECT_EQ(windowOf(mesh, 3, centers, 20).cells(), window.cells());
  Progress none;
  EXPECT_EQ(window.nearestCenters(centers, none).size(), expected.size());
}

TEST(RingWindow, GivesEachVertexItsNearestCenter)
{
  const StreamMesh mesh = toStream(torus(60, 40, 0.3));
  const int rings = 6;
  const Centers centers{ 900, 30, 905, 911, 905, 2000 };
  std::map<std::int64_t, std::pair<double, std::int64_t>> expected;
  for (std::size_t k = 0; k < centers.size(); ++k)
  {
    for (const std::int64_t vertex : ringsOf(mesh, centers[k], rings))
    {
      double squared = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double difference =
          mesh.positions[3 * centers[k] + axis] - mesh.positions[3 * vertex + axis];
        squared += difference * difference;
      }
      const std::pair candidate(squared, static_cast<std::int64_t>(k));
      const auto [entry, isNew] = expected.emplace(vertex, candidate);
      entry->second = std::min(entry->second, candidate);
    }
  }
  Progress none;
  const auto found = windowOf(mesh, rings, centers, 100).nearestCenters(centers, none);
  ASSERT_EQ(found.size(), expected.size());
  auto next = expected.begin();
  for (const auto& [vertex, center] : found)
  {
    EXPECT_EQ(vertex, next->first);
    EXPECT_EQ(center, next->second.second);
    ++next;
  }
}

} // namespace smg::testing
