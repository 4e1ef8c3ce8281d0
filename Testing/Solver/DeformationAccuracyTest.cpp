// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"

#include <gtest/gtest.h>

#include <utility>

// Compares the result of the two steps with two direct solves.

namespace smg::testing
{
namespace
{

/** Checks the error after 3, 6 and 9 V-cycles per step, plus `more`. */
void checkErrors(const IndexedTestMesh& given, int more = 0)
{
  const StreamMesh mesh = toStream(given);
  ArrayHandles handles = figureHandles(mesh);
  for (const Weights weights : { Weights::Uniform, Weights::Clamped, Weights::Cotangent })
  {
    const Eigen::MatrixXd direct = deformDirectly(mesh, handles, weights).positions;
    for (const auto& [cycles, allowed] : { std::pair(3, 2e-3), { 6, 1e-5 }, { 9, 1e-7 } })
    {
      const Solved solved = deformMesh(mesh, handles, withCycles(cycles + more, weights));
      EXPECT_LE(deformationError(mesh, solved.values, direct), allowed)
        << cycles + more << " cycles, weights " << static_cast<int>(weights);
    }
  }
}

} // namespace

TEST(DeformationAccuracyLaw, OfASurface)
{
  checkErrors(torus(300, 150, 0.3));
}

TEST(DeformationAccuracyLaw, OfABumpySurface)
{
  checkErrors(bumpy(torus(200, 100, 0.2), 0.3));
}

TEST(DeformationAccuracyLaw, OfASphere)
{
  checkErrors(sphere(6));
}

TEST(DeformationAccuracyLaw, OfASolid)
{
  // It converges slightly slower and takes one more V-cycle.
  checkErrors(tetBox(16, 24, 16, 0.15), 1);
}

TEST(DeformationAccuracy, ByToleranceIsThatOfTheTolerance)
{
  for (const StreamMesh& mesh : deformationMeshes())
  {
    ArrayHandles handles = figureHandles(mesh);
    const Eigen::MatrixXd direct = deformDirectly(mesh, handles).positions;
    const Solved solved = deformMesh(mesh, handles, byTolerance(1e-10));
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LT(deformationError(mesh, solved.values, direct), 1e-7);
  }
}

TEST(DeformationAccuracy, HeldVerticesAreAtTheirTargetsExactly)
{
  for (const StreamMesh& mesh : deformationMeshes())
  {
    ArrayHandles handles = figureHandles(mesh);
    const Solved solved = deformMesh(mesh, handles, withCycles(1));
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      for (int k = 0; k < 3 && handles.Values.mask[v] > 0; ++k)
      {
        ASSERT_EQ(solved.values(v, k), handles.Values.target[3 * v + k]);
      }
    }
  }
}

} // namespace smg::testing
