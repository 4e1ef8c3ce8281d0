// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/ScratchLimits.h"

#include "Testing/Solver/BlendTesting.h"
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Solver/SmoothTesting.h"

#include <gtest/gtest.h>

// Every computation keeps its scratch files below a limit.

namespace smg::testing
{
namespace
{

/** The result of a computation. */
struct Limited
{
  explicit Limited(Solved solved)
    : values(std::move(solved.values))
    , bytes(solved.report.scratch_bytes_peak)
  {
  }
  bool same(const Limited& other) const { return sameBits(this->values, other.values); }

  Eigen::MatrixXd values;
  std::int64_t bytes;
};

/** A surface whose finest levels are on scratch files. */
StreamMesh surface()
{
  return toStream(torus(120, 60, 0.3));
}

SolveOptions onFiles()
{
  SolveOptions options;
  options.coreNodes = 500;
  options.tolerance = 1e-4;
  return options;
}

} // namespace

TEST(ScratchLimit, OfASolve)
{
  const StreamMesh mesh = surface();
  ArrayProblem problem = heldEnds(mesh, 2, Weights::Clamped);
  expectScratchLimitKept(onFiles(),
    [&](const SolveOptions& options) { return Limited(solveMesh(mesh, problem, options)); });
}

TEST(ScratchLimit, OfADeformation)
{
  const StreamMesh mesh = surface();
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(2);
  options.coreNodes = 500;
  expectScratchLimitKept(options,
    [&](const DeformOptions& limited) { return Limited(deformMesh(mesh, handles, limited)); });
}

TEST(ScratchLimit, OfSmoothing)
{
  const StreamMesh mesh = surface();
  Smoothing options;
  static_cast<SolveOptions&>(options) = onFiles();
  options.steps = 2;
  expectScratchLimitKept(
    options, [&](const Smoothing& limited) { return Limited(smoothed(mesh, limited)); });
}

TEST(ScratchLimit, OfABlend)
{
  StreamMesh mesh = surface();
  addColumn(mesh, "patch", { quarter });
  addColumn(mesh, "u", { recordedSignal });
  const MemoryMesh stored(mesh);
  expectScratchLimitKept(onFiles(),
    [&](const SolveOptions& options)
    {
      const std::unique_ptr<Solution> blended = blend(stored, blendOf({ "u" }), options);
      return Limited({ valuesOf(*blended), blended->report() });
    });
}

TEST(ScratchLimit, OfADistance)
{
  const MemoryMesh mesh(surface());
  expectScratchLimitKept(DistanceOptions(),
    [&](const DistanceOptions& options) {
      return Limited(measure(mesh, fromVertices({ 0, 700 }), options));
    });
}

TEST(ScratchLimit, MustNotBeNegative)
{
  const StreamMesh mesh = surface();
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  SolveOptions options;
  options.scratchLimit = -1;
  EXPECT_NE(messageOf([&] { solveMesh(mesh, problem, options); }).find("limit of scratch files"),
    std::string::npos);
}

TEST(ScratchLimit, InCoreThereIsNothingToLimit)
{
  const StreamMesh mesh = surface();
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  SolveOptions options = onFiles();
  options.inCore = true;
  options.scratchLimit = 1;
  EXPECT_EQ(solveMesh(mesh, problem, options).report.scratch_bytes_peak, 0);
}

} // namespace smg::testing
