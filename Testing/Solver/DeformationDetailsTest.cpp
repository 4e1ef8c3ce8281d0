// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"

#include <gtest/gtest.h>

// Bumps rotate with the surface: the angle between the Laplacian vector of a vertex at rest,
// rotated by the interpolated rotation, and that of the deformed mesh is small.

namespace smg::testing
{
namespace
{

/** Bumps of two sizes on a triangle mesh. */
StreamMesh withBumps(const IndexedTestMesh& triangles)
{
  return toStream(bumpy(bumpy(triangles, 0.3, 1), 0.1, 2));
}

/** The median angle in degrees. */
double medianAngle(const StreamMesh& mesh, ArrayHandles& handles, Weights weights)
{
  const DirectDeformation direct = deformDirectly(mesh, handles, weights);
  const Solved solved = deformMesh(mesh, handles, withCycles(6, weights));
  const std::vector<double> angles =
    detailAngles(mesh, handles.Values, direct, solved.values, weights);
  return angles[angles.size() / 2];
}

} // namespace

TEST(DeformationDetails, TurnWithTheSurface)
{
  for (const IndexedTestMesh& shape : { torus(200, 100, 0.2), sphere(6) })
  {
    const StreamMesh mesh = withBumps(shape);
    ArrayHandles handles = figureHandles(mesh);
    for (const Weights weights : BothWeights)
    {
      EXPECT_LT(medianAngle(mesh, handles, weights), 5.0)
        << (weights == Weights::Uniform ? "uniform" : "cotangent");
    }
  }
}

TEST(DeformationDetails, TurnAlongABentTube)
{
  const StreamMesh mesh = withBumps(tube(64, 241, 20.0, 0.2));
  for (const double degrees : { 90.0, 200.0 })
  {
    ArrayHandles handles = endHandles(mesh, {}, turn(degrees, { 0, 0, 1 }));
    for (const Weights weights : BothWeights)
    {
      EXPECT_LT(medianAngle(mesh, handles, weights), 5.0) << degrees << " degrees";
    }
  }
}

} // namespace smg::testing
