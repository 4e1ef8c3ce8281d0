// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/InteractiveDeformation.h"
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Support/Combinations.h"

#include <gtest/gtest.h>

#include <limits>

// An interactive deformation equals deform() bit for bit, independent of previous updates.

namespace smg::testing
{
namespace
{

/** The current positions of an interactive deformation. */
Eigen::MatrixXd shown(InteractiveDeformation& deformation)
{
  return valuesOf(deformation);
}

/** The deformation meshes, and a mesh with a free component. */
std::vector<StreamMesh> interactiveMeshes()
{
  std::vector<StreamMesh> meshes = deformationMeshes();
  meshes.push_back(
    toStream(shuffled(disjointUnion(torus(60, 30, 0.3), sphere(2), { 0, 0, 5 })), TestOrder::Keep));
  return meshes;
}

} // namespace

TEST(InteractiveDeformation, EqualsDeformAfterAnySequenceOfUpdates)
{
  Combinations chosen;
  for (const StreamMesh& mesh : interactiveMeshes())
  {
    for (DeformOptions options :
      { withCycles(2), withCycles(3, Weights::Uniform), byTolerance(1e-6) })
    {
      if (!chosen.next())
      {
        continue;
      }
      options.coreNodes = 500;
      MemorySource source(mesh);
      ArrayHandles handles = figureHandles(mesh);
      InteractiveDeformation deformation(source, handles, options);
      EXPECT_EQ(deformation.vertices(), mesh.vertices());
      EXPECT_EQ(deformation.columns(), 3);
      EXPECT_TRUE(sameBits(shown(deformation), deformMesh(mesh, handles, options).values));
      for (const double degrees : { 10.0, 250.0, 0.0, -70.0, 70.0, 70.0 })
      {
        ArrayHandles next = figureHandles(mesh, degrees);
        ASSERT_TRUE(deformation.update(next.Values));
        const Solved expected = deformMesh(mesh, next, options);
        EXPECT_TRUE(sameBits(shown(deformation), expected.values)) << degrees;
        EXPECT_EQ(deformation.report().residuals, expected.report.residuals) << degrees;
        EXPECT_EQ(deformation.report().passes, expected.report.passes);
      }
    }
  }
}

TEST(InteractiveDeformation, DoesNotDependOnThreadsOrBlocks)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  ArrayHandles next = figureHandles(mesh, 20);
  const Solved expected = deformMesh(mesh, next, withCycles(2));
  for (const int threads : { 1, 2, 5 })
  {
    for (const std::int64_t blockCells : { 7, 100000 })
    {
      DeformOptions options = withCycles(2);
      options.threads = threads;
      MemorySource source(mesh, blockCells);
      InteractiveDeformation deformation(source, handles, options);
      ASSERT_TRUE(deformation.update(next.Values));
      EXPECT_TRUE(sameBits(shown(deformation), expected.values)) << threads << " threads";
    }
  }
}

TEST(InteractiveDeformation, GoesThroughIdentity)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  MemorySource source(mesh);
  InteractiveDeformation deformation(source, handles, byTolerance(1e-6));
  ArrayHandles identity(mesh.vertices());
  identity.hold(mesh, [](const Eigen::Vector3d&) { return true; });
  identity.Values.mask = handles.Values.mask;
  ASSERT_TRUE(deformation.update(identity.Values));
  EXPECT_EQ(deformationError(mesh, shown(deformation), positionsOf(mesh)), 0.0);
  ASSERT_TRUE(deformation.update(handles.Values));
  const Solved expected = deformMesh(mesh, handles, byTolerance(1e-6));
  EXPECT_TRUE(sameBits(shown(deformation), expected.values));
}

TEST(InteractiveDeformation, RefusesOtherHeldVertices)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  MemorySource source(mesh);
  InteractiveDeformation deformation(source, handles, withCycles(2));
  const Eigen::MatrixXd before = shown(deformation);
  const auto& mask = handles.Values.mask;
  const auto held = std::find_if(mask.begin(), mask.end(), [](auto m) { return m > 0; });
  const auto free = std::find(mask.begin(), mask.end(), 0);
  for (const auto changed : { held - mask.begin(), free - mask.begin() })
  {
    ArrayHandles other = figureHandles(mesh, 20);
    other.Values.mask[changed] = !other.Values.mask[changed];
    EXPECT_FALSE(deformation.update(other.Values));
    EXPECT_TRUE(sameBits(shown(deformation), before));
  }
  // The number of handles of a vertex has no effect.
  ArrayHandles shared = handles;
  shared.Values.mask[held - mask.begin()] = 3;
  EXPECT_TRUE(deformation.update(shared.Values));
  EXPECT_TRUE(sameBits(shown(deformation), before));
  EXPECT_EQ(deformation.report().shared, 1);
}

TEST(InteractiveDeformation, RefusesWhatIsNotFiniteOrNotOfThisMesh)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  MemorySource source(mesh);
  InteractiveDeformation deformation(source, handles, withCycles(2));
  const auto& mask = handles.Values.mask;
  const auto held = std::find_if(mask.begin(), mask.end(), [](auto m) { return m > 0; });
  VertexHandles bad = handles.Values;
  bad.target[3 * (held - mask.begin())] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(messageOf([&] { deformation.update(bad); }).find("finite"), std::string::npos);
  VertexHandles fewer;
  fewer.clear(3);
  EXPECT_NE(messageOf([&] { deformation.update(fewer); }), "");
  // And goes on.
  ArrayHandles next = figureHandles(mesh, 30);
  ASSERT_TRUE(deformation.update(next.Values));
  const Solved expected = deformMesh(mesh, next, withCycles(2));
  EXPECT_TRUE(sameBits(shown(deformation), expected.values));
}

TEST(InteractiveDeformation, AnUpdateBuildsNothing)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  MemorySource source(mesh);
  InteractiveDeformation deformation(source, handles, withCycles(3));
  EXPECT_GT(deformation.report().seconds.build, 0.0);
  EXPECT_EQ(deformation.report().bytes_written, 0);
  ArrayHandles next = figureHandles(mesh, 30);
  ASSERT_TRUE(deformation.update(next.Values));
  EXPECT_EQ(deformation.report().seconds.build, 0.0);
  EXPECT_EQ(deformation.report().steps.size(), 2u);
  EXPECT_GT(deformation.report().levels.size(), 1u);
}

TEST(InteractiveDeformation, FailsAsDeformDoes)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles nothing(mesh.vertices());
  MemorySource source(mesh);
  const auto begin = [&] { InteractiveDeformation(source, nothing, withCycles(2)); };
  EXPECT_NE(messageOf(begin), "");
}

TEST(InteractiveDeformation, IsRightAgainAfterAnUpdateThatWasCancelledAnywhere)
{
  const StreamMesh mesh = deformationMeshes()[0];
  ArrayHandles handles = figureHandles(mesh);
  ArrayHandles next = figureHandles(mesh, 30);
  int calls = 0;
  int cancelAt = std::numeric_limits<int>::max();
  double lowest = 1.0;
  DeformOptions options = withCycles(2);
  options.blockNodes = 500;
  options.progress = [&](double done)
  {
    lowest = std::min(lowest, done);
    return calls++ != cancelAt;
  };
  const Solved expected = deformMesh(mesh, next, options);
  MemorySource source(mesh);
  InteractiveDeformation deformation(source, handles, options);
  calls = 0;
  lowest = 1.0;
  ASSERT_TRUE(deformation.update(handles.Values));
  const int all = calls;
  EXPECT_LT(lowest, 0.2) << "progress begins anew";
  std::vector<double> values(3 * mesh.vertices());
  for (int k = 0; k < all; ++k)
  {
    calls = 0;
    cancelAt = k;
    EXPECT_THROW(deformation.update(handles.Values), Cancelled);
    EXPECT_NE(messageOf([&] { deformation.read(0, mesh.vertices(), values); }), "");
    cancelAt = std::numeric_limits<int>::max();
    ASSERT_TRUE(deformation.update(next.Values));
    EXPECT_TRUE(sameBits(shown(deformation), expected.values)) << "cancelled at call " << k;
  }
}

} // namespace smg::testing
