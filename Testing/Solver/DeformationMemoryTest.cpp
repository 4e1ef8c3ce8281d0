// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Solver/MemoryGrowth.h"
#include "Testing/Solver/MemoryLimits.h"

#include <gtest/gtest.h>

// The memory of a deformation grows with the width of the stream and stays within the limit.

namespace smg::testing
{
namespace
{

Report oneCycleAStep(const StreamMesh& mesh)
{
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(1);
  options.coreNodes = 1000;
  return deformMesh(mesh, handles, options).report;
}

} // namespace

TEST(DeformationMemoryLaw, OfASurfaceIsTheSquareRoot)
{
  expectGrowth(oneCycleAStep,
    { toStream(torus(316, 158)), toStream(torus(632, 316)), toStream(torus(1264, 632)) }, 2.2, 2.4);
}

TEST(DeformationMemoryLaw, OfASolidIsThePowerTwoThirds)
{
  // Ordered plane by plane. Coarse rows become longer with the number of levels.
  const auto planes = [](int n) { return toStream(tetBox(n, n, n), TestOrder::Keep); };
  expectGrowth(oneCycleAStep, { planes(32), planes(64) }, 4.4, 6.5);
}

TEST(DeformationMemoryLaw, OfAStripIsItsWidth)
{
  expectGrowth(oneCycleAStep, { toStream(grid(2000, 40)), toStream(grid(8000, 40)) }, 1.25, 1.25);
}

TEST(DeformationMemory, DoesNotGrowWithTheNumberOfCycles)
{
  const StreamMesh mesh = toStream(torus(316, 158, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(2);
  options.coreNodes = 1000;
  const Report few = deformMesh(mesh, handles, options).report;
  options.cycles = 6;
  const Report many = deformMesh(mesh, handles, options).report;
  EXPECT_LE(static_cast<double>(many.pool_bytes_peak), 1.02 * few.pool_bytes_peak);
}

TEST(DeformationMemory, StaysWithinTheLimit)
{
  const StreamMesh mesh = toStream(torus(200, 100, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  expectLimitsKept(withCycles(2), 1 << 27,
    [&](const DeformOptions& limited) { return deformMesh(mesh, handles, limited).report; });
}

TEST(DeformationMemory, ALimitBelowTheNeedNamesBothFiguresAtOnce)
{
  const StreamMesh mesh = toStream(torus(300, 150, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(1);
  options.coreNodes = 1000;
  options.threads = 1; // more of them need more memory, if there is any
  const std::int64_t need = deformMesh(mesh, handles, options).report.pool_bytes_peak;
  options.memoryLimit = need / 4;
  expectLimitRefused(mesh, options,
    [&](MeshSource& source, const DeformOptions& limited) { deform(source, handles, limited); });
}

TEST(DeformationMemory, InCoreTheNeedIsKnownBefore)
{
  const StreamMesh mesh = toStream(torus(400, 200, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(1);
  options.inCore = true;
  const std::int64_t need = deformMesh(mesh, handles, options).report.pool_bytes_peak;
  options.memoryLimit = need * 7 / 10;
  expectLimitRefused(mesh, options,
    [&](MeshSource& source, const DeformOptions& limited) { deform(source, handles, limited); });
}

} // namespace smg::testing
