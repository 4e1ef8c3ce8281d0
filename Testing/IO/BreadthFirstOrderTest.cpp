// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/BreadthFirstOrder.h"

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/InCorePages.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace smg::testing
{

namespace
{

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/** Expects the order of a mesh to be breadth-first except for its sources. */
OrderSize expectGoodOrder(const Neighbours& neighbours, std::span<const double> positions,
  int pageVertices, std::int64_t memory, const BreadthFirstOptions& options = {})
{
  Workspace workspace({}, memory);
  PagedMesh mesh =
    pagesOf(neighbours, positions, alongCurve(positions), pageVertices, false, workspace);
  EXPECT_EQ(countComponents(mesh, workspace), inCoreComponents(neighbours));
  PageTraffic traffic;
  const OrderedVertices order = breadthFirstOrder(mesh, workspace, options, &traffic);
  EXPECT_EQ(mesh.counts.components, inCoreComponents(neighbours));
  EXPECT_EQ(traffic.pages, mesh.pages.pages());
  EXPECT_GE(traffic.loads, 1);
  EXPECT_GE(traffic.probes, mesh.counts.components);
  const ReadOrder read = readOrder(order);
  EXPECT_EQ(order.count, std::int64_t(neighbours.vertices()));
  expectOrder(neighbours, read, neighbours.vertices());
  return orderSize(neighbours, read.ids);
}

OrderSize expectGoodOrder(const IndexedTestMesh& mesh, int pageVertices = 64,
  std::int64_t memory = Workspace::MinMemory, const BreadthFirstOptions& options = {})
{
  return expectGoodOrder(neighboursOf(mesh), mesh.positions, pageVertices, memory, options);
}

/** Lower is better. */
double costOf(const OrderSize& size)
{
  return (double(size.span) + size.meanWindow) / 2;
}

TEST(BreadthFirstOrder, IsAboutAsGoodAsInMemory)
{
  for (const IndexedTestMesh& mesh :
    { grid(120, 80), torus(150, 60), sphere(5), tetBox(12, 20, 15) })
  {
    const IndexedTestMesh input = shuffled(mesh);
    const Neighbours neighbours = neighboursOf(input);
    const OrderSize inCore = orderSize(neighbours, inCoreBreadthFirst(neighbours));
    EXPECT_LE(costOf(expectGoodOrder(input)), 1.1 * costOf(inCore));
    EXPECT_LE(
      costOf(expectGoodOrder(input, 64, Workspace::MinMemory, { 0, 4096 })), 1.2 * costOf(inCore));
  }
}

TEST(BreadthFirstOrder, OfManyComponentsPlannedOrNot)
{
  IndexedTestMesh mesh = sphere(2);
  for (int i = 1; i < 30; ++i)
  {
    mesh = disjointUnion(mesh,
      i % 5 == 0   ? sphere(4)
      : i % 3 == 0 ? grid(2, 2)
                   : torus(9, 9),
      { 3.0 * i, 1.0 * i, 0 });
  }
  const OrderSize whole = expectGoodOrder(shuffled(mesh), 50);
  const OrderSize planned = expectGoodOrder(shuffled(mesh), 50, Workspace::MinMemory, { 4, 100 });
  // Components are consecutive: no window is larger than that of the largest component.
  EXPECT_LT(whole.span, 300);
  EXPECT_LT(planned.span, 300);
}

TEST(BreadthFirstOrder, OfGraphsWithoutShape)
{
  Random random(3);
  Edges edges;
  std::vector<double> positions;
  for (std::uint32_t i = 0; i < 5000; ++i)
  {
    edges.emplace_back(i, random.below(5000));
    edges.emplace_back((i + 1) % 5000, random.below(5000));
    positions.insert(positions.end(), 3, 0.0);
  }
  for (std::uint32_t i = 0; i < 5000; ++i)
  {
    edges.emplace_back(i, i < 4999 ? i + 1 : 0);
  }
  expectGoodOrder(neighboursOf(5000, edges), positions, 16, Workspace::MinMemory);
}

TEST(BreadthFirstOrder, OfAFan)
{
  const std::uint32_t rim = 60000;
  Edges edges;
  std::vector<double> positions(3);
  for (std::uint32_t i = 1; i <= rim; ++i)
  {
    edges.emplace_back(0, i);
    edges.emplace_back(i, i % rim + 1);
    positions.insert(positions.end(), { double(i), 1, 0 });
  }
  expectGoodOrder(neighboursOf(rim + 1, edges), positions, 256, Workspace::MinMemory);
}

TEST(BreadthFirstOrder, OfSeparateTriangles)
{
  Random random(5);
  Edges edges;
  std::vector<double> positions;
  for (std::uint32_t i = 0; i < 3000; ++i)
  {
    edges.insert(
      edges.end(), { { 3 * i, 3 * i + 1 }, { 3 * i + 1, 3 * i + 2 }, { 3 * i + 2, 3 * i } });
    for (int k = 0; k < 9; ++k)
    {
      positions.push_back(random.uniform());
    }
  }
  const OrderSize size =
    expectGoodOrder(neighboursOf(9000, edges), positions, 100, Workspace::MinMemory);
  EXPECT_EQ(size.span, 2);
}

TEST(BreadthFirstOrder, OfNothing)
{
  Workspace workspace({}, Workspace::MinMemory);
  PagedMesh mesh{ VertexPages(workspace, 64, true), {}, {}, 1, 0 };
  mesh.pages.close();
  PageTraffic traffic;
  EXPECT_EQ(breadthFirstOrder(mesh, workspace, {}, &traffic).count, 0);
  EXPECT_EQ(mesh.counts.components, 0);
  EXPECT_EQ(countComponents(mesh, workspace), 0);
}

/** The remaining memory holds three pages, which are loaded repeatedly. */
TEST(BreadthFirstOrder, WithAlmostNoMemory)
{
  const IndexedTestMesh mesh = shuffled(torus(200, 200));
  const Neighbours neighbours = neighboursOf(mesh);
  std::vector<std::uint32_t> plenty, little;
  for (const bool isLittle : { false, true })
  {
    Workspace workspace({}, Workspace::MinMemory);
    PagedMesh paged = pagesOf(mesh, 100, workspace);
    Buffer taken;
    if (isLittle)
    {
      const std::int64_t enough = (std::int64_t(1536) << 10) + (std::int64_t(800) << 10);
      taken = Buffer(workspace.pool(), std::size_t(workspace.available() - enough));
    }
    PageTraffic traffic;
    const OrderedVertices order = breadthFirstOrder(paged, workspace, { 4, 4096 }, &traffic);
    const ReadOrder read = readOrder(order);
    expectOrder(neighbours, read, neighbours.vertices());
    (isLittle ? little : plenty) = read.ids;
    EXPECT_LE(workspace.pool().peak(), workspace.pool().limit());
    EXPECT_EQ(traffic.probeLoads > 2 * traffic.pages, isLittle);
  }
  EXPECT_EQ(little, plenty);
}

TEST(BreadthFirstOrder, NoMemoryIsAnErrorThatSaysWhatToDo)
{
  Workspace workspace({}, Workspace::MinMemory);
  PagedMesh mesh = pagesOf(sphere(3), 64, workspace);
  const Buffer taken(workspace.pool(), std::size_t(workspace.available() - (100 << 10)));
  expectError([&] { breadthFirstOrder(mesh, workspace); }, "raise the memory limit");
}

} // namespace

} // namespace smg::testing
