// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"

#include <gtest/gtest.h>

// Components without handles do not move at all.

namespace smg::testing
{
namespace
{

/** Two held tori among free components: spheres and hundreds of single cells. */
IndexedTestMesh manyThings()
{
  IndexedTestMesh mesh = disjointUnion(torus(60, 30, 0.2), sphere(4), { 0.1, 0.2, 9 });
  const IndexedTestMesh triangle{ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1, 2 } };
  for (int k = 0; k < 100; ++k)
  {
    mesh = disjointUnion(mesh, k % 2 ? triangle : sphere(0), { 3.0 * k, 1.0 / 3.0, 19 });
  }
  return disjointUnion(mesh, torus(50, 25, 0.2), { -3, 0, 29 });
}

bool isOnHeldTorus(double z)
{
  return z < 5 || z > 25;
}

/** The vertices of both tori with large x move, those with small x are fixed. */
ArrayHandles torusHandles(const StreamMesh& mesh)
{
  ArrayHandles handles(mesh.vertices());
  handles.hold(mesh, [](const Eigen::Vector3d& p) { return isOnHeldTorus(p.z()) && p.x() < -2; });
  handles.hold(
    mesh, [](const Eigen::Vector3d& p) { return isOnHeldTorus(p.z()) && p.x() > 2; }, anyMotion());
  return handles;
}

} // namespace

TEST(DeformationComponents, WithoutHandlesStayExactly)
{
  for (const TestOrder order : { TestOrder::BreadthFirst, TestOrder::Keep })
  {
    const StreamMesh mesh = toStream(shuffled(manyThings(), 5), order);
    ArrayHandles handles = torusHandles(mesh);
    for (DeformOptions options : { withCycles(1), withCycles(5), byTolerance(1e-10) })
    {
      for (const bool core : { false, true })
      {
        options.inCore = core;
        options.coreNodes = 300;
        const Solved solved = deformMesh(mesh, handles, options);
        EXPECT_EQ(solved.report.components, 103);
        EXPECT_EQ(solved.report.free_components, 101);
        for (std::int64_t v = 0; v < mesh.vertices(); ++v)
        {
          for (int k = 0; k < 3 && !isOnHeldTorus(mesh.positions[3 * v + 2]); ++k)
          {
            ASSERT_EQ(solved.values(v, k), mesh.positions[3 * v + k]) << "vertex " << v;
          }
        }
      }
    }
  }
}

TEST(DeformationComponents, DoNotDisturbTheOthers)
{
  const StreamMesh mesh = toStream(shuffled(manyThings(), 5));
  ArrayHandles handles = torusHandles(mesh);
  for (const Weights weights : BothWeights)
  {
    const Solved solved = deformMesh(mesh, handles, byTolerance(1e-10, weights));
    EXPECT_TRUE(solved.report.converged);
    const Eigen::MatrixXd direct = deformDirectly(mesh, handles, weights).positions;
    EXPECT_LT(deformationError(mesh, solved.values, direct), 1e-8);
  }
}

TEST(DeformationComponents, FlatCellsHoldTheirCornersTogetherAndDuplicatesDoNot)
{
  // Flagged cells and cells without area, on separate vertices.
  IndexedTestMesh given = torus(60, 30, 0.3);
  const IndexedTestMesh flat{ CellType::Triangle, { 0, 0, 7, 1, 0, 7, 2, 0, 7 }, { 0, 1, 2 } };
  const IndexedTestMesh fine{ CellType::Triangle, { 0, 1, 7, 1, 1, 7, 2, 2, 7 }, { 0, 1, 2 } };
  given = disjointUnion(disjointUnion(given, flat), fine);
  StreamMesh mesh = toStream(given);
  std::vector<std::uint8_t> flags(mesh.cells());
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const double* p = &mesh.positions[3 * mesh.corners[3 * c]];
    flags[c] = p[2] == 7.0 && p[1] > 0.5 ? DuplicateCell : 0;
  }
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));

  ArrayHandles handles(mesh.vertices());
  handles.hold(mesh, [](const Eigen::Vector3d& p) { return p.x() < -2; });
  handles.hold(
    mesh, [](const Eigen::Vector3d& p) { return p.x() > 2 && p.z() < 5; }, anyMotion());
  // One of them is held and follows its handle.
  handles.hold(
    mesh, [](const Eigen::Vector3d& p) { return p.x() == 0 && p.z() == 7 && p.y() == 0; },
    anyMotion());
  for (const bool core : { false, true })
  {
    DeformOptions options = withCycles(3);
    options.inCore = core;
    const Solved solved = deformMesh(mesh, handles, options);
    EXPECT_EQ(solved.report.held, 3);
    const Eigen::MatrixXd direct = deformDirectly(mesh, handles).positions;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      for (int k = 0; k < 3 && mesh.positions[3 * v + 2] == 7.0; ++k)
      {
        EXPECT_NEAR(solved.values(v, k), direct(v, k), 1e-9);
      }
    }
  }
}

TEST(DeformationComponents, AllVerticesHeldIsWhatTheHandlesSay)
{
  const StreamMesh mesh = toStream(torus(20, 10, 0.2));
  ArrayHandles handles(mesh.vertices());
  handles.hold(
    mesh, [](const Eigen::Vector3d&) { return true; }, anyMotion());
  for (const DeformOptions& options : { withCycles(2), byTolerance(1e-6) })
  {
    const Solved solved = deformMesh(mesh, handles, options);
    EXPECT_EQ(deformationError(mesh, solved.values, moved(mesh, anyMotion())), 0.0);
  }
}

TEST(DeformationComponents, OneHeldVertexMovesAllOfItsComponent)
{
  const StreamMesh mesh = toStream(torus(40, 20, 0.2));
  ArrayHandles handles(mesh.vertices());
  handles.hold(
    mesh, [](const Eigen::Vector3d&) { return true; }, anyMotion());
  std::fill(handles.Values.mask.begin(), handles.Values.mask.end(), 0);
  handles.Values.mask[77] = 1;
  const Solved solved = deformMesh(mesh, handles, byTolerance(1e-12));
  EXPECT_LT(deformationError(mesh, solved.values, moved(mesh, anyMotion())), 1e-7);
}

TEST(DeformationComponents, AVertexInFlatCellsAloneGoesWithItsNeighbours)
{
  // A vertex in the middle of an edge, connected to its ends by a triangle without area.
  IndexedTestMesh given = torus(60, 30, 0.3);
  const std::int64_t a = given.corners[0];
  const std::int64_t b = given.corners[1];
  const auto middle = static_cast<std::int64_t>(given.positions.size() / 3);
  for (int k = 0; k < 3; ++k)
  {
    given.positions.push_back(0.5 * (given.positions[3 * a + k] + given.positions[3 * b + k]));
  }
  given.corners.insert(given.corners.end(), { a, middle, b });
  const StreamMesh mesh = toStream(given);
  for (const Weights weights : BothWeights)
  {
    ArrayHandles handles(mesh.vertices());
    handles.hold(
      mesh, [](const Eigen::Vector3d& p) { return std::fabs(p.x()) > 2.5; }, anyMotion());
    const Solved solved = deformMesh(mesh, handles, byTolerance(1e-10, weights));
    EXPECT_EQ(solved.report.degenerate_cells, 1);
    EXPECT_LT(deformationError(mesh, solved.values, moved(mesh, anyMotion())), 1e-8);
  }
}

TEST(DeformationComponents, AFarOneDoesNotSpoilTheOthers)
{
  // Rounding is relative to edges and motions, not to coordinates of 1e12 elsewhere.
  const StreamMesh mesh =
    toStream(disjointUnion(torus(60, 30, 0.2), torus(40, 20, 0.2), { 1e12, 0, 0 }));
  ArrayHandles handles(mesh.vertices());
  Motion small;
  small.translation = { 1e-3, 0, 0 };
  handles.hold(mesh, [](const Eigen::Vector3d& p) { return p.x() < -2; });
  handles.hold(
    mesh, [](const Eigen::Vector3d& p) { return p.x() > 2 && p.x() < 9; }, small);
  const Solved solved = deformMesh(mesh, handles, byTolerance(1e-6));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_GE(solved.report.steps[1].cycles, 3);
  const Eigen::MatrixXd direct = deformDirectly(mesh, handles).positions;
  double largest = 0.0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double x = mesh.positions[3 * v];
    largest = x < 9 ? std::max(largest, std::fabs(solved.values(v, 0) - direct(v, 0))) : largest;
  }
  EXPECT_LT(largest, 1e-3 * 1e-4);
}

} // namespace smg::testing
