// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ArrayHandles.h"
#include "Testing/Support/Bumps.h"
#include "Testing/Support/DeformMesh.h"
#include "Testing/Support/DirectDeformation.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace smg::testing
{

/** An open tube of radius 1 along z, from z = 0 to z = length. */
inline IndexedTestMesh tube(int around, int along, double length, double jitter = 0.0)
{
  IndexedTestMesh mesh;
  Random random(1);
  for (int j = 0; j < along; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const double angle =
        2 * std::numbers::pi * (i + 0.5 * (j % 2) + random.uniform(-jitter, jitter)) / around;
      mesh.positions.insert(
        mesh.positions.end(), { std::cos(angle), std::sin(angle), length * j / (along - 1) });
    }
  }
  for (int j = 0; j + 1 < along; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const std::int64_t a = std::int64_t(j) * around + i;
      const std::int64_t b = std::int64_t(j) * around + (i + 1) % around;
      const std::int64_t c = a + around;
      const std::int64_t d = b + around;
      if (j % 2 == 0)
      {
        mesh.corners.insert(mesh.corners.end(), { a, b, c, b, d, c });
      }
      else
      {
        mesh.corners.insert(mesh.corners.end(), { a, b, d, a, d, c });
      }
    }
  }
  return mesh;
}

/** Holds the ends of a mesh in z: the lower one by `low`, the upper one by `high`. */
inline ArrayHandles endHandles(
  const StreamMesh& mesh, const Motion& low, const Motion& high, double fraction = 0.05)
{
  const Eigen::VectorXd z = positionsOf(mesh).col(2);
  const double bottom = z.minCoeff() + fraction * (z.maxCoeff() - z.minCoeff());
  const double top = z.maxCoeff() - fraction * (z.maxCoeff() - z.minCoeff());
  ArrayHandles handles(mesh.vertices());
  handles.hold(
    mesh, [=](const Eigen::Vector3d& p) { return p.z() <= bottom; }, low);
  handles.hold(
    mesh, [=](const Eigen::Vector3d& p) { return p.z() >= top; }, high);
  return handles;
}

/** A motion of every kind at once. */
inline Motion anyMotion()
{
  Motion motion = turn(75.0, { 1, -2, 0.5 }, { 0.3, 0.1, 2.0 });
  motion.scale = 1.4;
  motion.translation = { 0.5, 1.5, -0.5 };
  return motion;
}

/** Surfaces and solids of a few thousand vertices, in a good and in a random order. */
inline std::vector<StreamMesh> deformationMeshes()
{
  const IndexedTestMesh surface = shuffled(bumpy(torus(110, 60, 0.4), 0.2));
  const IndexedTestMesh solid = shuffled(tetBox(12, 16, 25, 0.15));
  return { toStream(surface), toStream(surface, TestOrder::Keep), toStream(solid),
    toStream(solid, TestOrder::Keep) };
}

} // namespace smg::testing
