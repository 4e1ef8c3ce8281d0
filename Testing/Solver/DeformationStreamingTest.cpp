// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Support/AtOnce.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/SolutionRanges.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

// Streaming equals the in-core deformation bit for bit, for all windows.

namespace smg::testing
{
namespace
{

/** A fixed number of cycles, and a tolerance. */
const std::vector<DeformOptions> ManyWays = { withCycles(2), withCycles(3, Weights::Uniform),
  byTolerance(1e-5) };

Solved inCore(const StreamMesh& mesh, ArrayHandles& handles, DeformOptions options)
{
  options.inCore = true;
  return deformMesh(mesh, handles, options);
}

/** Checks that results and residuals equal those in core, for all meshes and options of `vary`. */
template <class Vary>
void expectBits(Vary vary)
{
  Combinations chosen;
  for (const StreamMesh& mesh : deformationMeshes())
  {
    ArrayHandles handles = figureHandles(mesh);
    for (const DeformOptions& options : ManyWays)
    {
      const Solved expected = inCore(mesh, handles, options);
      EXPECT_EQ(expected.report.bytes_written, 0);
      vary(options,
        [&](const DeformOptions& varied, std::int64_t blockCells)
        {
          if (!chosen.next())
          {
            return;
          }
          SCOPED_TRACE("blocks of " + std::to_string(blockCells) + " cells and " +
                       std::to_string(varied.blockNodes) + " nodes, " +
                       std::to_string(varied.coreNodes) + " core nodes, " +
                       std::to_string(varied.threads) + " threads, " +
                       std::to_string(varied.cycles) + " cycles");
          const Solved solved = deformMesh(mesh, handles, varied, blockCells);
          EXPECT_TRUE(sameBits(solved.values, expected.values));
          EXPECT_EQ(solved.report.residuals, expected.report.residuals);
        });
    }
  }
}

} // namespace

TEST(DeformationStreaming, EqualsInCoreForAllWindows)
{
  expectBits(
    [](DeformOptions options, const auto& check)
    {
      for (const std::int64_t coreNodes : { 0, 500, 50000 })
      {
        for (const std::int64_t blockNodes : { 64, 1000, 1 << 20 })
        {
          options.coreNodes = coreNodes;
          options.blockNodes = blockNodes;
          check(options, 1000);
        }
      }
    });
}

TEST(DeformationStreaming, DoesNotDependOnHowTheMeshComesInBlocks)
{
  expectBits(
    [](DeformOptions options, const auto& check)
    {
      options.coreNodes = 500;
      for (const std::int64_t blockCells : { 1, 17, 5000, 1 << 20 })
      {
        check(options, blockCells);
      }
    });
}

TEST(DeformationStreaming, DoesNotDependOnTheNumberOfThreads)
{
  expectBits(
    [](DeformOptions options, const auto& check)
    {
      options.coreNodes = 500;
      for (const int threads : { 1, 2, 3, 8, 16 })
      {
        for (const bool core : { false, true })
        {
          options.threads = threads;
          options.inCore = core;
          check(options, 1000);
        }
      }
    });
}

TEST(DeformationStreaming, EqualsInCoreForEveryNumberOfSweeps)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  for (const int sweeps : { 1, 3, 7 })
  {
    DeformOptions options = withCycles(2);
    options.sweeps = sweeps;
    options.coreNodes = 500;
    const Solved expected = inCore(mesh, handles, options);
    EXPECT_TRUE(sameBits(deformMesh(mesh, handles, options).values, expected.values));
  }
}

TEST(DeformationStreaming, TheSolutionHasTheSameBitsInAnyRange)
{
  const StreamMesh mesh = deformationMeshes()[1];
  ArrayHandles handles = figureHandles(mesh);
  for (const bool core : { false, true })
  {
    DeformOptions options = withCycles(2);
    options.inCore = core;
    options.coreNodes = 500;
    MemorySource source(mesh);
    const std::unique_ptr<Solution> solution = deform(source, handles, options);
    ASSERT_EQ(solution->columns(), 3);
    ASSERT_EQ(solution->vertices(), mesh.vertices());
    expectRangesOfTheWhole(*solution);
  }
}

TEST(DeformationStreaming, TwoDeformationsAtOnceDoNotDisturbEachOther)
{
  const std::vector<StreamMesh> meshes = deformationMeshes();
  std::vector<Solved> results(2);
  DeformOptions options = withCycles(2);
  options.coreNodes = 500;
  runAtOnce(2,
    [&](int k)
    {
      ArrayHandles handles = figureHandles(meshes[2 * k]);
      results[k] = deformMesh(meshes[2 * k], handles, options);
    });
  for (const int k : { 0, 1 })
  {
    ArrayHandles handles = figureHandles(meshes[2 * k]);
    EXPECT_TRUE(sameBits(results[k].values, inCore(meshes[2 * k], handles, options).values));
  }
}

TEST(DeformationStreaming, LeavesNoScratchFileBehind)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(1);
  options.scratch = folder.path();
  options.coreNodes = 500;
  MemorySource source(mesh);
  {
    const std::unique_ptr<Solution> solution = deform(source, handles, options);
    EXPECT_GT(folder.entries(), 0);
  }
  EXPECT_EQ(folder.entries(), 0);
  options.inCore = true;
  source.rewind(1000);
  const std::unique_ptr<Solution> solution = deform(source, handles, options);
  EXPECT_EQ(folder.entries(), 0);
}

} // namespace smg::testing
