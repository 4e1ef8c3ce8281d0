// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Mesh/MeshPrefetch.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

/** A mesh that may be read on any thread, or on the caller's alone, up to the block `Failing`. */
struct CountedSource : MemorySource
{
  using MemorySource::MemorySource;
  bool readsOnAnyThread() const override { return this->OnAnyThread; }
  bool next(MeshBlock& block) override
  {
    if (++this->Asked == this->Failing)
    {
      throw Error("the block cannot be read");
    }
    return MemorySource::next(block);
  }
  int Asked = 0, Failing = 0;
  bool OnAnyThread = true;
};

/** Two strips, a cell of each in turn, which the last cell joins: most vertices are final before.
 */
IndexedTestMesh joinedStrips(int length)
{
  const IndexedTestMesh strip = grid(length, 3);
  const std::int64_t other = strip.vertices();
  IndexedTestMesh mesh;
  mesh.positions = strip.positions;
  for (std::int64_t v = 0; v < other; ++v)
  {
    const double* p = strip.positions.data() + 3 * v;
    mesh.positions.insert(mesh.positions.end(), { p[0], p[1] + 10.0, p[2] });
  }
  // Along the strips: by the first of the three vertices across.
  std::vector<std::int64_t> cells(strip.cells());
  std::iota(cells.begin(), cells.end(), 0);
  std::ranges::stable_sort(
    cells, {}, [&](std::int64_t c) { return strip.corners[3 * c] % length; });
  for (const std::int64_t c : cells)
  {
    const std::int64_t* corner = strip.corners.data() + 3 * c;
    mesh.corners.insert(mesh.corners.end(), corner, corner + 3);
    mesh.corners.insert(
      mesh.corners.end(), { corner[0] + other, corner[1] + other, corner[2] + other });
  }
  mesh.corners.insert(mesh.corners.end(), { other - 1, other - 1 - length, 2 * other - 1 });
  return mesh;
}

} // namespace

TEST(MeshPrefetch, DeliversTheBlocksOfTheStreamInOrder)
{
  for (const bool ahead : { false, true })
  {
    CountedSource source(toStream(torus(30, 20)), 100);
    const std::int64_t blocks = (source.info().cells + 99) / 100;
    MeshPrefetch stream(source, ahead);
    std::int64_t vertices = 0, cells = 0;
    for (int n = 1;; ++n)
    {
      stream.advance();
      const MeshBlock* block = stream.block();
      if (!block)
      {
        break;
      }
      EXPECT_EQ(block->firstVertex, vertices);
      EXPECT_EQ(block->firstCell, cells);
      vertices += block->vertices();
      cells += static_cast<std::int64_t>(block->corners.size()) / 3;
      stream.read();
      EXPECT_EQ(source.Asked, ahead ? n + 1 : n);
    }
    EXPECT_EQ(vertices, source.info().vertices);
    EXPECT_EQ(cells, source.info().cells);
    for (int k = 0; k < 3; ++k)
    {
      stream.advance();
      stream.read();
    }
    EXPECT_EQ(source.Asked, blocks + 1); // not again after the end
  }
}

TEST(MeshPrefetch, SaysAFailureWhenTheBlocksBeforeItHaveBeenUsed)
{
  CountedSource source(toStream(torus(30, 20)), 100);
  source.Failing = 3;
  MeshPrefetch stream(source, true);
  for (int n = 1; n < 3; ++n)
  {
    stream.advance();
    EXPECT_NE(stream.block(), nullptr);
    stream.read();
  }
  stream.advance();
  expectError([&] { stream.block(); }, "the block cannot be read");
}

TEST(MeshPrefetch, DoesNotChangeTheSolution)
{
  const StreamMesh mesh = toStream(joinedStrips(900), TestOrder::Keep);
  ArrayProblem held = heldEnds(mesh, 1, Weights::Cotangent);
  ArrayProblem targets = heldEnds(mesh, 3, Weights::Clamped);
  targets.Target = [](const double* p, const double* q, double* d)
  { std::transform(p, p + 3, q, d, std::minus<>()); };
  ArrayProblem free;
  free.Columns = 2;
  Random random(5);
  for (std::int64_t k = 0; k < 2 * mesh.vertices(); ++k)
  {
    free.Source.push_back(random.uniform(-1.0, 1.0));
    free.Value.push_back(random.uniform(3.0, 5.0));
  }
  SolveOptions options;
  options.maxCycles = 3;
  options.coreNodes = 100;
  for (ArrayProblem* problem : { &held, &targets, &free })
  {
    options.threads = 1;
    const Solved expected = solveMesh(mesh, *problem, options);
    EXPECT_EQ(expected.report.free_components, problem == &free ? 1 : 0);
    for (const std::int64_t blockCells : { 100, 2000 })
    {
      for (const auto& [threads, onAnyThread] :
        { std::pair(8, false), std::pair(2, true), std::pair(8, true) })
      {
        CountedSource source(mesh, blockCells);
        source.OnAnyThread = onAnyThread;
        options.threads = threads;
        const Solved solved = solveMesh(source, *problem, options);
        EXPECT_TRUE(sameBits(solved.values, expected.values)) << threads << " threads";
        EXPECT_EQ(solved.report.removed_source, expected.report.removed_source);
        EXPECT_EQ(solved.report.residuals, expected.report.residuals);
      }
    }
  }
}

TEST(MeshPrefetch, ASolveSaysTheFirstFailureOfTheStream)
{
  const StreamMesh mesh = toStream(torus(60, 40));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  problem.Value[50] = NAN;
  CountedSource source(mesh, 100);
  source.Failing = 3;
  SolveOptions options;
  options.threads = 4;
  expectError([&] { solve(source, problem, options); }, "is not a finite number");
  ArrayProblem right = heldEnds(mesh, 1, Weights::Cotangent);
  CountedSource again(mesh, 100);
  again.Failing = 3;
  expectError([&] { solve(again, right, options); }, "the block cannot be read");
}

} // namespace smg::testing
