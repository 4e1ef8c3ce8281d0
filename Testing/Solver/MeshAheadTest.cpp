// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Stream/MeshAhead.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace smg::testing
{
namespace
{

/** A mesh that may be read on any thread, up to the block `Failing`. */
struct AnyThreadSource : MemorySource
{
  using MemorySource::MemorySource;
  bool readsOnAnyThread() const override { return true; }
  bool next(MeshBlock& block) override
  {
    if (++this->Asked == this->Failing)
    {
      throw Error("the block cannot be read");
    }
    return MemorySource::next(block);
  }
  int Asked = 0, Failing = 0;
};

} // namespace

TEST(MeshAhead, DeliversTheBlocksOfTheStreamInOrder)
{
  for (const bool ahead : { false, true })
  {
    AnyThreadSource source(toStream(torus(30, 20)), 100);
    const std::int64_t blocks = (source.info().cells + 99) / 100;
    MeshAhead stream(source, ahead);
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
    EXPECT_EQ(source.Asked, blocks + 1); // not again after the end
  }
}

TEST(MeshAhead, SaysAFailureWhenTheBlocksBeforeItHaveBeenUsed)
{
  AnyThreadSource source(toStream(torus(30, 20)), 100);
  source.Failing = 3;
  MeshAhead stream(source, true);
  for (int n = 1; n < 3; ++n)
  {
    stream.advance();
    EXPECT_NE(stream.block(), nullptr);
    stream.read();
  }
  stream.advance();
  expectError([&] { stream.block(); }, "the block cannot be read");
}

TEST(MeshAhead, DoesNotChangeTheSolution)
{
  const StreamMesh mesh = toStream(torus(60, 40));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  SolveOptions options;
  options.maxCycles = 3;
  options.threads = 1;
  const Eigen::MatrixXd expected = solveMesh(mesh, problem, options).values;
  for (const int threads : { 2, 4 })
  {
    AnyThreadSource source(mesh, 100);
    options.threads = threads;
    const auto solution = solve(source, problem, options);
    EXPECT_TRUE(sameBits(valuesOf(*solution), expected));
  }
}

TEST(MeshAhead, ASolveSaysTheFirstFailureOfTheStream)
{
  const StreamMesh mesh = toStream(torus(60, 40));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  problem.Value[50] = NAN;
  AnyThreadSource source(mesh, 100);
  source.Failing = 3;
  SolveOptions options;
  options.threads = 4;
  expectError([&] { solve(source, problem, options); }, "is not a finite number");
  ArrayProblem right = heldEnds(mesh, 1, Weights::Cotangent);
  AnyThreadSource again(mesh, 100);
  again.Failing = 3;
  expectError([&] { solve(again, right, options); }, "the block cannot be read");
}

} // namespace smg::testing
