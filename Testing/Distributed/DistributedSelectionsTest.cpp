// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/DeformMesh.h"
#include "Testing/Support/DescribedMesh.h"

#include <gtest/gtest.h>

#include <numeric>

// What a description selects depends on the whole mesh, wherever it is cut.

namespace smg::testing
{
namespace
{

/** A mesh with columns, and the numbers of its vertices. */
StreamMesh numberedMesh(const IndexedTestMesh& shape)
{
  StreamMesh mesh = describedMesh(shape);
  std::vector<std::int64_t> ids(static_cast<std::size_t>(mesh.vertices()));
  std::iota(ids.rbegin(), ids.rend(), 0); // not those of the stream
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>(OriginalIdName, ids));
  return mesh;
}

/** Everything that is selected in a way of its own. */
ProblemDescription everyPlace()
{
  ProblemDescription problem;
  problem.conductivity = { { Everywhere{}, 2.0 }, { ColumnTag{ "tag", 3 }, "K" },
    { OnBoundary{}, 3.0 } };
  problem.source = { { Everywhere{}, 1.0 },
    { NearestVertices{ { { 1, 1, 1 }, { 1.5, 1.5, 1.5 }, { 0, 0, 0 } } }, 40.0 } };
  problem.dirichlet = { { ColumnTag{ "tag", 3 }, "one" },
    { Region::Vertices{ { 3, 7, 11 } }, -1.0 } };
  problem.flux = { { OnBoundary{}, 0.5 }, { Region::HalfSpace{ { 0, 1, 0 }, 2.5 }, "one" } };
  problem.robin = { { Region::HalfSpace{ { 1, 0, 0 }, 2.5 }, 2.0, "one" } };
  problem.soft = { { OnBoundary{}, 0.5, 1.0 }, { ColumnMask{ "cellMask" }, "one", 2.0 } };
  return problem;
}

} // namespace

TEST(DistributedSelections, AgreeWithTheStreamingEngine)
{
  // In the last one, several vertices are equally near to a point.
  for (const IndexedTestMesh& shape : { tetBox(5, 4, 4, 0.1), grid(9, 8, 0.2), tetBox(5, 4, 4) })
  {
    const StreamMesh mesh = numberedMesh(shuffled(shape));
    const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
    DescribedProblem problem(everyPlace(), part.info);
    DistributedSolver solver(MPI_COMM_WORLD, part);
    solver.prepare(problem);
    DistributedOptions options;
    options.tolerance = 1e-10;
    const DistributedSolution solution = solver.solve(problem, options);
    EXPECT_TRUE(solution.report.converged);
    const Eigen::MatrixXd values = wholeSolution(solver, solution);
    if (rankOfTest() == 0)
    {
      MemorySource source(mesh);
      DescribedProblem whole(everyPlace(), source.info());
      whole.prepare(source);
      source.rewind(1000);
      const Solved streamed = solveMesh(source, whole, accurate(1e-10));
      EXPECT_EQ(solution.report.prescribed, streamed.report.prescribed);
      EXPECT_LT((values - streamed.values).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

/** Handles that are selected in each way; the second one holds nothing that the last one leaves. */
DeformationDescription everyHandle()
{
  DeformationDescription handles;
  const HandleMotion turn({ .axis = { 1, 2, 3 }, .degrees = 20.0, .scale = 1.2 });
  handles.handles = { { ColumnTag{ "tag", 3 }, turn },
    { Region::Vertices{ { 3, 7, 11 } }, HandleMotion({ .translation = { 0, 0, 1 } }) },
    { NearestVertices{ { { 1, 1, 1 }, { 1.5, 1.5, 1.5 } } },
      HandleDescription::Values{ .targets = { { 1, 1, 1.5 }, { 2, 2, 2 } } } },
    { OnBoundary{}, HandleMotion() }, { Region::Vertices{ { 3, 7, 11 } }, turn } };
  return handles;
}

TEST(DistributedSelections, OfHandlesAgreeWithTheStreamingEngine)
{
  for (const IndexedTestMesh& shape : { tetBox(5, 4, 4, 0.1), grid(9, 8, 0.2), tetBox(5, 4, 4) })
  {
    const StreamMesh mesh = numberedMesh(shuffled(shape));
    const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
    DescribedHandles handles(everyHandle(), part.info);
    DistributedSolver solver(MPI_COMM_WORLD, part);
    solver.prepare(handles);
    DistributedOptions options;
    options.tolerance = 1e-10;
    const DistributedSolution solution = solver.deform(handles, Weights::Clamped, options);
    const std::vector<std::string> notes = solver.notes(handles);
    const Eigen::MatrixXd values = wholeSolution(solver, solution);
    if (rankOfTest() == 0)
    {
      MemorySource source(mesh);
      DescribedHandles whole(everyHandle(), source.info());
      whole.prepare(source);
      const Solved streamed = deformMesh(mesh, whole, byTolerance(1e-10));
      EXPECT_EQ(notes, whole.notes());
      EXPECT_EQ(notes.size(), 1U);
      EXPECT_EQ(solution.report.notes, streamed.report.notes);
      EXPECT_EQ(solution.report.prescribed, streamed.report.prescribed);
      EXPECT_LT((values - streamed.values).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

TEST(DistributedSelections, OfNothingAreErrorsOnAllProcesses)
{
  const auto messageWith = [](const IndexedTestMesh& shape, const Where& where)
  {
    const StreamMesh mesh = numberedMesh(shape);
    const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
    ProblemDescription description;
    description.dirichlet = { { where, 1.0 } };
    DistributedSolver solver(MPI_COMM_WORLD, part);
    DescribedProblem problem(description, part.info);
    return messageOf([&] { solver.prepare(problem); });
  };
  const IndexedTestMesh solid = tetBox(4, 3, 3);
  EXPECT_TRUE(contains(messageWith(solid, Region::Sphere{ { 50, 0, 0 }, 1 }), "no vertex"));
  EXPECT_TRUE(contains(messageWith(solid, Region::Vertices{ { 1, 4000 } }), "4000"));
  EXPECT_TRUE(contains(messageWith(solid, ColumnTag{ "tag", 7 }), "no vertex"));
  EXPECT_TRUE(contains(messageWith(torus(7, 6), OnBoundary{}), "the mesh is closed"));
  EXPECT_TRUE(contains(messageWith(solid, ColumnMask{ "nan" }), "is not a number"));
  EXPECT_EQ(messageWith(solid, Region::Vertices{ { 1, 2 } }), "");
}

} // namespace smg::testing
