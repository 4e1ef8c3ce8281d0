// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"

#include <gtest/gtest.h>

#include <numbers>

// The mesh follows the handles.

namespace smg::testing
{
namespace
{

/** The difference from the motion if all handles of a figure have the same motion. */
double errorOfCommonMotion(
  const StreamMesh& mesh, const Motion& motion, const DeformOptions& options)
{
  const VertexHandles figure = figureHandles(mesh).Values;
  ArrayHandles handles(mesh.vertices());
  handles.hold(
    mesh, [](const Eigen::Vector3d&) { return true; }, motion);
  handles.Values.mask = figure.mask;
  const Solved solved = deformMesh(mesh, handles, options);
  return deformationError(mesh, solved.values, moved(mesh, motion));
}

/** The angle, in degrees and in (-180, 180], by which the vertices at height z turned about z. */
double angleAt(const StreamMesh& mesh, const Eigen::MatrixXd& positions, double z, double width)
{
  double sine = 0.0;
  double cosine = 0.0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    if (std::abs(p[2] - z) <= width)
    {
      cosine += p[0] * positions(v, 0) + p[1] * positions(v, 1);
      sine += p[0] * positions(v, 1) - p[1] * positions(v, 0);
    }
  }
  return std::atan2(sine, cosine) * 180.0 / std::numbers::pi;
}

} // namespace

TEST(DeformationMotion, IdentityGivesTheInputBack)
{
  for (const StreamMesh& mesh : deformationMeshes())
  {
    for (const Weights weights : BothWeights)
    {
      for (const int cycles : { 1, 3, 9 })
      {
        EXPECT_LE(errorOfCommonMotion(mesh, {}, withCycles(cycles, weights)), 1e-9) << cycles;
      }
    }
  }
}

TEST(DeformationMotion, IdentityByToleranceGivesTheInputBackExactly)
{
  for (const StreamMesh& mesh : deformationMeshes())
  {
    for (const Weights weights : BothWeights)
    {
      EXPECT_EQ(errorOfCommonMotion(mesh, {}, byTolerance(1e-6, weights)), 0.0);
    }
  }
}

TEST(DeformationMotion, RigidMotionsOfAllHandlesAreTheMeshs)
{
  Motion motion = turn(130.0, { 1, 2, -1 }, { 0.5, 0, 1 });
  motion.translation = { 3, -1, 2 };
  for (const StreamMesh& mesh : deformationMeshes())
  {
    for (const Weights weights : BothWeights)
    {
      EXPECT_LT(errorOfCommonMotion(mesh, motion, byTolerance(1e-12, weights)), 1e-9);
      EXPECT_LT(errorOfCommonMotion(mesh, motion, withCycles(9, weights)), 1e-5);
    }
  }
}

TEST(DeformationMotion, TranslationsOfAllHandlesAreTheMeshs)
{
  Motion motion;
  motion.translation = { 0.3, -20, 1e-3 };
  for (const StreamMesh& mesh : deformationMeshes())
  {
    EXPECT_LT(errorOfCommonMotion(mesh, motion, byTolerance(1e-12)), 1e-9);
  }
}

TEST(DeformationMotion, ScalesAboutOneCentreAreASimilarity)
{
  Motion motion;
  motion.center = { 1, 0.5, -0.25 };
  for (const double scale : { 0.25, 1.7, 10.0 })
  {
    motion.scale = scale;
    for (const StreamMesh& mesh : deformationMeshes())
    {
      EXPECT_LT(errorOfCommonMotion(mesh, motion, byTolerance(1e-12)), 1e-9 * scale + 1e-9);
    }
  }
}

TEST(DeformationMotion, TurnsTheLongWayRound)
{
  // One end is rotated by 200 degrees: the middle by 100, not by -80.
  const StreamMesh surface = toStream(tube(48, 161, 20.0, 0.2));
  IndexedTestMesh box = tetBox(7, 7, 61, 0.1);
  for (std::size_t k = 0; k < box.positions.size(); ++k)
  {
    box.positions[k] = (box.positions[k] - (k % 3 == 2 ? 0.0 : 3.0)) / 3.0;
  }
  for (const StreamMesh& mesh : { surface, toStream(box) })
  {
    for (const double degrees : { 200.0, -200.0, 340.0, 500.0 })
    {
      ArrayHandles handles = endHandles(mesh, {}, turn(degrees, { 0, 0, 1 }));
      for (const Weights weights : BothWeights)
      {
        const Solved solved = deformMesh(mesh, handles, byTolerance(1e-9, weights));
        EXPECT_TRUE(solved.report.converged);
        for (const double part : { 0.25, 0.5, 0.75 })
        {
          // The held ends are 5 % each; the angle is linear between them.
          const double expected = degrees * (part - 0.05) / 0.9;
          const double found = angleAt(mesh, solved.values, 20.0 * part, 0.4);
          EXPECT_NEAR(std::remainder(found - expected, 360.0), 0.0, 4.0)
            << degrees << " degrees, at " << part;
        }
      }
    }
  }
}

TEST(DeformationMotion, ATranslatedEndShearsWithoutTurning)
{
  // A handle without rotation: the mesh in between is interpolated harmonically.
  const StreamMesh mesh = toStream(tube(32, 101, 10.0, 0.2));
  Motion motion;
  motion.translation = { 4, 0, 0 };
  ArrayHandles handles = endHandles(mesh, {}, motion, 0.0);
  const Solved solved = deformMesh(mesh, handles, byTolerance(1e-10));
  const Eigen::MatrixXd shift = solved.values - positionsOf(mesh);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    EXPECT_NEAR(shift(v, 0), 0.4 * mesh.positions[3 * v + 2], 0.02);
    EXPECT_NEAR(shift(v, 1), 0.0, 0.02);
    EXPECT_NEAR(shift(v, 2), 0.0, 0.02);
  }
}

} // namespace smg::testing
