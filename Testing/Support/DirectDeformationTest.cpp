// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectDeformation.h"
#include "Testing/Support/ArrayHandles.h"
#include "Testing/Support/Bumps.h"
#include "Testing/Support/DeformMesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

bool isEnd(const Eigen::Vector3d& point)
{
  return point.x() < -2.5 || point.x() > 2.5;
}

} // namespace

TEST(DirectDeformation, HandlesThatMoveAlikeMoveTheMeshAlike)
{
  Motion motion = turn(130.0, { 1, 2, 3 }, { 0.5, 0, 1 });
  motion.scale = 0.7;
  motion.translation = { 5, 0, -2 };
  for (const Weights weights : BothWeights)
  {
    for (const Motion& given : { Motion(), motion })
    {
      const StreamMesh mesh = toStream(bumpy(torus(40, 20, 0.3), 0.3));
      ArrayHandles handles(mesh.vertices());
      handles.hold(mesh, isEnd, given);
      const DirectDeformation direct = deformDirectly(mesh, handles, weights);
      EXPECT_LT(deformationError(mesh, direct.positions, moved(mesh, given)), 1e-12);
      const auto angles = detailAngles(mesh, handles.Values, direct, direct.positions, weights);
      EXPECT_EQ(static_cast<std::int64_t>(angles.size()), mesh.vertices() - handles.held());
      EXPECT_LT(angles.back(), 1e-5);
    }
  }
}

TEST(DirectDeformation, TheFieldsAreHarmonic)
{
  // In a straight beam with held ends they are linear.
  const StreamMesh mesh = toStream(tetBox(21, 4, 4));
  ArrayHandles handles(mesh.vertices());
  Motion motion = turn(200.0, { 1, 2, 3 });
  motion.scale = 2.0;
  handles.hold(mesh, [](const Eigen::Vector3d& p) { return p.x() == 0.0; });
  handles.hold(
    mesh, [](const Eigen::Vector3d& p) { return p.x() == 20.0; }, motion);
  const DirectDeformation direct = deformDirectly(mesh, handles);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double fraction = mesh.positions[3 * v] / 20.0;
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(direct.fields(v, k), motion.rotation[k] * fraction, 1e-3);
    }
    EXPECT_NEAR(direct.fields(v, 3), std::log(2.0) * fraction, 1e-3);
  }
}

TEST(DirectDeformation, WhatNoHandleReachesStays)
{
  const StreamMesh mesh =
    toStream(shuffled(disjointUnion(torus(30, 15), sphere(2), { 0.123, 0, 8 })));
  ArrayHandles handles(mesh.vertices());
  handles.hold(
    mesh, [](const Eigen::Vector3d& p) { return p.z() < 2 && p.x() > 2; }, turn(70, { 1, 0, 0 }));
  const DirectDeformation direct = deformDirectly(mesh, handles);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < 3 && mesh.positions[3 * v + 2] > 5; ++k)
    {
      EXPECT_EQ(direct.positions(v, k), mesh.positions[3 * v + k]);
    }
  }
}

} // namespace smg::testing
