// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

// A solve that ends in the middle of a pass continues with the same bits. Testing/Examples/
// smg_checkpoint.py kills the program at any moment.

namespace smg::testing
{
namespace
{

/** Small levels on disk. */
SolveOptions streamed(const std::filesystem::path& folder)
{
  SolveOptions options;
  options.tolerance = 1e-11;
  options.coreNodes = 100;
  options.blockNodes = 300;
  options.checkpoint = { folder, "mesh", "problem" };
  return options;
}

Solved withoutCheckpoint(const StreamMesh& mesh, ArrayProblem problem, SolveOptions options)
{
  options.checkpoint = {};
  return solveMesh(mesh, problem, options);
}

/** Solves, and cancels each of the calls after this many reports of progress, until one ends.
 * Returns the number of calls. */
int solveInParts(const StreamMesh& mesh, ArrayProblem problem, SolveOptions options, int reports,
  const Solved& expected)
{
  for (int calls = 1;; ++calls)
  {
    int left = reports;
    options.progress = [&](double) { return --left > 0; };
    try
    {
      MemorySource source(mesh);
      const std::unique_ptr<Solution> solution = solve(source, problem, options);
      EXPECT_TRUE(sameBits(valuesOf(*solution), expected.values));
      const Report& report = solution->report();
      EXPECT_EQ(report.residuals, expected.report.residuals);
      EXPECT_EQ(report.passes, expected.report.passes);
      EXPECT_EQ(report.levels.size(), expected.report.levels.size());
      EXPECT_EQ(report.acceleration, expected.report.acceleration);
      EXPECT_EQ(report.resumed_passes > 0, calls > 1 && hasNote(report, "continued after pass"));
      solution->removeCheckpoint();
      EXPECT_TRUE(std::filesystem::exists(options.checkpoint.folder));
      return calls;
    }
    catch (const Cancelled&)
    {
    }
  }
}

void expectSameInParts(const StreamMesh& mesh, const ArrayProblem& problem, SolveOptions options)
{
  const Solved expected = withoutCheckpoint(mesh, problem, options);
  ASSERT_GE(expected.report.levels.size(), 3U);
  ASSERT_GE(expected.report.passes, 6);
  EXPECT_GE(solveInParts(mesh, problem, options, 50, expected), 4);
  EXPECT_FALSE(std::filesystem::exists(options.checkpoint.folder));
}

} // namespace

TEST(SolveCheckpoint, WhatNothingDeterminesInPartsIsNoNumber)
{
  const TemporaryFolder folder;
  IndexedTestMesh torn = torus(110, 60, 0.4);
  for (std::int64_t v = 0; v < 6000; v += 1000)
  {
    const std::int64_t added = torn.vertices();
    for (int axis = 0; axis < 3; ++axis)
    {
      torn.positions.push_back(torn.positions[static_cast<std::size_t>(3 * v + axis)]);
    }
    torn.corners.insert(torn.corners.end(), { v, added, v + 1 });
  }
  const StreamMesh mesh = toStream(shuffled(torn), TestOrder::BreadthFirst);
  ArrayProblem problem = heldEnds(mesh, 3, Weights::Cotangent);
  problem.KeepsUndetermined = false;
  const SolveOptions options = streamed(folder / "ck");
  const Solved whole = withoutCheckpoint(mesh, problem, options);
  EXPECT_GE(whole.report.held, 3); // of those that are not prescribed
  EXPECT_EQ(whole.values.array().isNaN().count(), 3 * whole.report.held);
  expectSameInParts(mesh, problem, options);
}

TEST(SolveCheckpoint, FlatTetrahedraInPartsHaveTheSameBits)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = toStream(shuffled(tetBox(18, 18, 17, 0.33)), TestOrder::BreadthFirst);
  expectSameInParts(mesh, heldEnds(mesh, 1, Weights::Cotangent), streamed(folder / "ck"));
}

TEST(SolveCheckpoint, AnAutomaticToleranceInPartsHasTheSameBits)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = toStream(shuffled(tetBox(18, 18, 17, 0.33)), TestOrder::BreadthFirst);
  SolveOptions options = streamed(folder / "ck");
  options.tolerance = SolveOptions::AutomaticTolerance;
  options.again = [&mesh] { return std::make_unique<MemorySource>(mesh); };
  options.acceleration = AccelerationKind::None;
  options.sweeps = 1;
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  problem.Source.assign(static_cast<std::size_t>(mesh.vertices()), 1.0);
  const Report whole = withoutCheckpoint(mesh, problem, options).report;
  ASSERT_TRUE(whole.errors); // which ended it
  ASSERT_GT(whole.residual(), 1e-11);
  expectSameInParts(mesh, problem, options);
}

TEST(SolveCheckpoint, ValuesFarFromZeroInPartsHaveTheSameBits)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = toStream(shuffled(torus(110, 60, 0.4)), TestOrder::BreadthFirst);
  constexpr int Columns = 5;
  ArrayProblem problem = heldEnds(mesh, Columns, Weights::Cotangent);
  for (std::size_t i = 0; i < problem.Value.size(); ++i)
  {
    problem.Value[i] += problem.Prescribed[i / Columns] ? 1e3 : 0.0;
  }
  SolveOptions options = streamed(folder / "ck");
  options.tolerance = 1e-8;
  expectSameInParts(mesh, problem, options);
}

TEST(SolveCheckpoint, NeedsWhatItIsOf)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = toStream(torus(20, 10), TestOrder::BreadthFirst);
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Uniform);
  SolveOptions options;
  options.checkpoint.folder = folder / "ck";
  expectError([&] { solveMesh(mesh, problem, options); }, "identify the mesh and the problem");
  options = streamed(folder / "ck");
  options.inCore = true;
  expectError([&] { solveMesh(mesh, problem, options); }, "in core");
  EXPECT_EQ(folder.entries(), 0);
}

} // namespace smg::testing
