// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/Isosurface.h"
#include "Testing/Support/Refinement.h"
#include "Testing/Support/Sanitized.h"

#include <gtest/gtest.h>

#include <functional>

// The number of V-cycles does not grow with the mesh: with two refinements by at most one, for
// surfaces and solids, good ones and noisy ones.

namespace smg::testing
{
namespace
{

/** V-cycles of the default to 1e-6. */
int cyclesOn(const IndexedTestMesh& indexed)
{
  const StreamMesh mesh = toStream(indexed);
  ArrayProblem problem = heldEnds(mesh, 3, Weights::Cotangent);
  SolveOptions options;
  options.tolerance = 1e-6;
  options.threads = 2;
  const Report report = solveMesh(mesh, problem, options, 20000).report;
  EXPECT_TRUE(report.converged);
  return report.cycles;
}

/** Of meshes with this many times the samples along each axis. */
void expectNoGrowth(const std::function<IndexedTestMesh(int)>& meshOf)
{
  const int before = cyclesOn(meshOf(1)), after = cyclesOn(meshOf(Sanitized ? 2 : 4));
  EXPECT_LE(after, before + 1);
}

} // namespace

TEST(ConvergenceLaw, GoodSurfaces)
{
  expectNoGrowth([](int times) { return torus(200 * times, 100 * times, 0.2); });
}

TEST(ConvergenceLaw, NoisySurfaces)
{
  for (const std::uint64_t seed : { 1, 2 })
  {
    expectNoGrowth([seed](int times) { return noisyGyroid(24 * times, 0.05, seed); });
  }
}

/** With less noise more samples are next to the level: their clusters of vertices are closer. */
TEST(ConvergenceLaw, ClustersOnSurfacesCostFewCycles)
{
  EXPECT_LE(cyclesOn(noisyGyroid(Sanitized ? 60 : 120, 0.02, 1)), 7);
  EXPECT_LE(cyclesOn(noisyGyroid(Sanitized ? 60 : 120, 0.02, 2)), 9);
}

/** Few coarse triangles of up to 179.9 degrees, refined: lattices of obtuse triangles. With rows
 * of P that do not reproduce linear functions V-cycles are twice as many on the finer one. */
TEST(ConvergenceLaw, LatticesOfCaps)
{
  IndexedTestMesh mesh = withCaps(torus(36, 19, 0.3), 200);
  for (int times = 0; times < (Sanitized ? 3 : 4); ++times)
  {
    mesh = refined(mesh);
  }
  EXPECT_LE(cyclesOn(mesh), 7);
  EXPECT_LE(cyclesOn(refined(mesh)), 8);
}

TEST(ConvergenceLaw, GoodSolids)
{
  expectNoGrowth([](int times) { return tetBox(15 * times, 15 * times, 15 * times); });
}

TEST(ConvergenceLaw, NoisySolids)
{
  expectNoGrowth([](int times) { return tetBox(15 * times, 15 * times, 15 * times, 0.19); });
}

// To 2.3 million vertices of surfaces and 1.7 million of solids.

TEST(ConvergenceLawLong, GoodSurfaces)
{
  expectNoGrowth([](int times) { return torus(540 * times, 270 * times, 0.2); });
}

/** Of 2.8 million vertices. */
TEST(ConvergenceLawLong, LatticesOfCaps)
{
  IndexedTestMesh mesh = withCaps(torus(36, 19, 0.3), 200);
  for (int times = 0; times < 6; ++times)
  {
    mesh = refined(mesh);
  }
  EXPECT_LE(cyclesOn(mesh), 9);
}

TEST(ConvergenceLawLong, Solids)
{
  for (const double jitter : { 0.0, 0.19 })
  {
    expectNoGrowth(
      [jitter](int times) { return tetBox(30 * times, 30 * times, 30 * times, jitter); });
  }
}

} // namespace smg::testing
