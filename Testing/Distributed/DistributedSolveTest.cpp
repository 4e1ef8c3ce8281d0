// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/WaveProblem.h"

#include <gtest/gtest.h>

// On any number of processes, a solution is that of the streaming engine and of a direct solve.

namespace smg::testing
{
namespace
{

/** Of the range of the solution. */
constexpr double Tolerance = 1e-6;

std::vector<StreamMesh> meshes()
{
  return { patch(24, 21), toStream(shuffled(torus(30, 16, 0.2))), block(8, 7, 6),
    toStream(shuffled(tetBox(12, 4, 5, 0.15))) };
}

struct Solutions
{
  Eigen::MatrixXd distributed, streamed; ///< on process 0
  Report report, ofStream;
};

/** Solves on the parts, and on process 0 with the streaming engine. */
Solutions solveBoth(
  const StreamMesh& mesh, const std::vector<std::int64_t>& cuts, const Setting& set)
{
  Solutions both;
  const MeshPart part = partOf(mesh, cuts);
  const StreamMesh own = meshOf(part);
  ElementProblem problem(own);
  problem.Columns = WaveColumns;
  set(problem);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  DistributedOptions options;
  options.tolerance = 1e-10;
  const DistributedSolution solution = solver.solve(problem, options);
  both.report = solution.report;
  both.distributed = wholeSolution(solver, solution);
  if (rankOfTest() == 0)
  {
    ElementProblem whole(mesh);
    whole.Columns = WaveColumns;
    set(whole);
    Solved streamed = solveMesh(mesh, whole, accurate(1e-10));
    both.streamed = std::move(streamed.values);
    both.ofStream = std::move(streamed.report);
  }
  return both;
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return (a - b).cwiseAbs().maxCoeff() / (b.maxCoeff() - b.minCoeff());
}

/** Expects the solutions to agree, and the counts of the reports. */
void expectEqual(const Solutions& both, const std::string& name)
{
  EXPECT_TRUE(both.report.converged) << name;
  if (rankOfTest() != 0)
  {
    return;
  }
  EXPECT_LT(distance(both.distributed, both.streamed), Tolerance) << name;
  const Report& a = both.report;
  const Report& b = both.ofStream;
  EXPECT_EQ(a.vertices, b.vertices) << name;
  EXPECT_EQ(a.cells, b.cells) << name;
  EXPECT_EQ(a.prescribed, b.prescribed) << name;
  EXPECT_EQ(a.held, b.held) << name;
  EXPECT_EQ(a.clamped_weights, b.clamped_weights) << name;
  EXPECT_EQ(a.components, b.components) << name;
  EXPECT_EQ(a.free_components, b.free_components) << name;
  EXPECT_EQ(a.levels.front().nodes, b.levels.front().nodes) << name;
  EXPECT_EQ(a.levels.front().nonzeros, b.levels.front().nonzeros) << name;
  ASSERT_EQ(a.removed_source.size(), b.removed_source.size()) << name;
  for (std::size_t k = 0; k < a.removed_source.size(); ++k)
  {
    EXPECT_NEAR(a.removed_source[k], b.removed_source[k], 1e-9) << name;
  }
}

void everything(ElementProblem& p)
{
  p.Conductivity = someTensor;
  p.CellScreening = [](const Point&) { return 0.02; };
  p.VertexScreening = [](const Point&) { return 0.01; };
  p.CellSource = p.VertexSource = columnsOf(WaveColumns, wave);
  p.CellField = [](const Point& x) -> Eigen::MatrixXd
  { return Eigen::MatrixXd::Constant(3, WaveColumns, 0.4 + 0.1 * x[1]); };
  p.FluxConditions.push_back({ above(0, 4.0), columnsOf(WaveColumns, wave) });
  p.RobinConditions.push_back(
    { above(1, 3.0), [](const Point&) { return 2.0; }, columnsOf(WaveColumns, wave) });
}

/** Problems with some vertices prescribed, with every datum. */
std::vector<std::pair<std::string, Setting>> finiteElements()
{
  const auto held = [](ElementProblem& p)
  {
    p.DirichletConditions.push_back({ below(0, 0.6), columnsOf(WaveColumns, wave) });
    everything(p);
  };
  return { { "Dirichlet, flux and Robin",
             [held](ElementProblem& p)
             {
               held(p);
               p.Conductivity = {};
             } },
    { "tensor", held } };
}

} // namespace

TEST(DistributedSolve, AgreesWithTheStreamingEngine)
{
  for (const StreamMesh& mesh : meshes())
  {
    for (const auto& [name, set] : finiteElements())
    {
      expectEqual(solveBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()), set), name);
    }
  }
}

TEST(DistributedSolve, AgreesWithOtherWeights)
{
  for (const StreamMesh& mesh : { patch(), block() })
  {
    for (const Weights weights : { Weights::Clamped, Weights::Uniform })
    {
      const auto set = [weights](ElementProblem& p)
      {
        finiteElements().front().second(p);
        p.EdgeWeights = weights;
      };
      expectEqual(solveBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()), set), "other weights");
    }
  }
}

TEST(DistributedSolve, AgreesWithADirectSolve)
{
  const Setting set = finiteElements().back().second;
  for (const StreamMesh& mesh : { patch(), block() })
  {
    const Solutions both = solveBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()), set);
    if (rankOfTest() == 0)
    {
      ElementProblem whole(mesh);
      whole.Columns = WaveColumns;
      set(whole);
      EXPECT_LT(distance(both.distributed, DirectElements(whole).solve()), Tolerance);
    }
  }
}

TEST(DistributedSolve, ProcessesMayLackCells)
{
  const Setting set = finiteElements().front().second;
  const StreamMesh surface = patch(), solid = block();
  expectEqual(solveBoth(surface, cutsWithGaps(surface.cells(), sizeOfTest(), 0), set), "gaps");
  expectEqual(solveBoth(solid, cutsWithGaps(solid.cells(), sizeOfTest(), 1), set), "gaps");
  std::vector<std::int64_t> cuts(static_cast<std::size_t>(sizeOfTest()) + 1, solid.cells());
  cuts.front() = 0;
  expectEqual(solveBoth(solid, cuts, set), "all cells on process 0");
}

TEST(DistributedSolve, FreeComponentsKeepTheirMean)
{
  const Setting sources = [](ElementProblem& p)
  {
    p.VertexSource = columnsOf(WaveColumns, wave);
    p.Initial = columnsOf(WaveColumns, [](const Point& x, int k) { return 2.0 + k + 0.1 * x[1]; });
  };
  const IndexedTestMesh small = grid(7, 5, 0.2), large = grid(14, 12, 0.2);
  const StreamMesh one = toStream(shuffled(torus(24, 12, 0.2)));
  const StreamMesh several = toStream(
    shuffled(disjointUnion(disjointUnion(small, large, { 0, 0, 5 }), small, { 100, 0, 0 })));
  const StreamMesh solid =
    toStream(shuffled(disjointUnion(tetBox(5, 6, 4, 0.1), tetBox(3, 8, 4, 0.1), { 30, 0, 0 })));
  for (const StreamMesh& mesh : { one, several, solid })
  {
    expectEqual(solveBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()), sources), "free");
  }
  const Setting someHeld = [&](ElementProblem& p)
  {
    sources(p);
    p.DirichletConditions.push_back({ above(0, 100.5), columnsOf(WaveColumns, wave) });
  };
  expectEqual(solveBoth(several, evenCuts(several.cells(), sizeOfTest()), someHeld), "one held");
}

/** The constant of such a component is the balance of its data, whatever rounding leaves of their
 * part in the matrix; some of the components here are held by the data of one process alone. */
TEST(DistributedSolve, ComponentsMayBeHeldLoosely)
{
  const StreamMesh surface =
    toStream(shuffled(disjointUnion(grid(7, 5, 0.2), grid(14, 12, 0.2), { 100, 0, 0 })));
  for (const StreamMesh& mesh : { surface, block(8, 7, 6) })
  {
    for (const double size : { 1e-4, 1e-7, 1e-9, 1e-12, 1e-15 })
    {
      for (const bool hasSource : { false, true })
      {
        const Setting set = [=](ElementProblem& p)
        {
          p.Initial = columnsOf(WaveColumns, [](const Point&, int k) { return 2.0 + k; });
          p.VertexSource = hasSource ? columnsOf(WaveColumns, wave) : ElementProblem::Values();
          p.RobinConditions.push_back(
            { above(1, 2.0), [=](const Point&) { return size; }, columnsOf(WaveColumns, wave) });
        };
        const Solutions both = solveBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()), set);
        const std::string name =
          std::to_string(std::log10(size)) + (hasSource ? " and a source" : "");
        // Between the components whose constants are held and those where they are in the kernel up
        // to rounding, the rounding of the constant ends the iteration earlier.
        EXPECT_TRUE(both.report.converged || both.report.residuals.back() < 1e-7) << name;
        if (rankOfTest() == 0)
        {
          EXPECT_EQ(both.report.free_components, both.ofStream.free_components) << name;
          EXPECT_LT((both.distributed - both.streamed).cwiseAbs().maxCoeff(),
            Tolerance * both.streamed.cwiseAbs().maxCoeff())
            << name;
        }
      }
    }
  }
}

TEST(DistributedSolve, WhatNothingDeterminesIsAsInAStream)
{
  IndexedTestMesh flat = grid(14, 12, 0.2);
  // A coincident vertex, as a clip makes it, of flat cells alone.
  const std::int64_t added = flat.vertices();
  for (int axis = 0; axis < 3; ++axis)
  {
    flat.positions.push_back(flat.positions[static_cast<std::size_t>(3 * 40 + axis)]);
  }
  flat.corners.insert(flat.corners.end(), { 40, 41, added, 40, added, 55 });
  const StreamMesh mesh = toStream(shuffled(flat));
  for (const bool keeps : { false, true })
  {
    const Solutions both = solveBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()),
      [keeps](ElementProblem& p)
      {
        p.DirichletConditions.push_back({ below(0, 0.6), columnsOf(WaveColumns, wave) });
        p.Initial = columnsOf(WaveColumns, wave);
        p.KeepsUndetermined = keeps;
      });
    EXPECT_EQ(both.report.held, 1);
    if (rankOfTest() == 0)
    {
      const auto missing = [](const Eigen::MatrixXd& x) { return x.array().isNaN(); };
      EXPECT_EQ(missing(both.streamed).count(), keeps ? 0 : WaveColumns);
      EXPECT_TRUE((missing(both.distributed) == missing(both.streamed)).all());
      const auto present = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd
      { return missing(x).select(0.0, x); };
      EXPECT_LT(distance(present(both.distributed), present(both.streamed)), Tolerance);
    }
  }
}

TEST(DistributedSolve, ANeedleBesideAPrescribedVertexDoesNotEndTheSolveEarly)
{
  const StreamMesh mesh = toStream(gridWithNeedle(40, 40, 1e-6));
  const auto problemOn = [](const StreamMesh& on)
  {
    ElementProblem problem(on);
    problem.Conductivity = [](const Point&)
    { return Eigen::Matrix3d(1e-3 * Eigen::Matrix3d::Identity()); };
    const auto isHot = [](const Point& x) { return x[0] == 20.0 && x[1] == 0.0; };
    problem.DirichletConditions = { { isHot, columnsOf(1, [](const Point&, int) { return 1.0; }) },
      { above(1, 33.0), columnsOf(1, [](const Point&, int) { return 0.0; }) } };
    return problem;
  };
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  ElementProblem problem = problemOn(own);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  DistributedOptions options;
  options.tolerance = 1e-6;
  const Eigen::MatrixXd solution = wholeSolution(solver, solver.solve(problem, options));
  if (rankOfTest() == 0)
  {
    ElementProblem whole = problemOn(mesh);
    EXPECT_LT(distance(solution, DirectElements(whole).solve()), 1e-5);
  }
}

TEST(DistributedSolve, EdgesOfSeveralPartsMayHaveManyCells)
{
  // A fan of triangles around one edge, and a chain of bow ties: edges and vertices that are not
  // manifold, each cell on another process.
  IndexedTestMesh mesh;
  mesh.positions = { 0, 0, 0, 0, 0, 1 };
  for (int k = 0; k < 9; ++k)
  {
    mesh.positions.insert(mesh.positions.end(), { std::cos(0.7 * k), std::sin(0.7 * k), 0.4 });
    mesh.corners.insert(mesh.corners.end(), { 0, 1, 2 + k });
  }
  const Setting set = [](ElementProblem& p)
  {
    p.DirichletConditions.push_back({ above(0, 0.9), columnsOf(WaveColumns, wave) });
    p.FluxConditions.push_back({ [](const Point&) { return true; }, columnsOf(WaveColumns, wave) });
  };
  const StreamMesh stream = toStream(mesh);
  expectEqual(solveBoth(stream, evenCuts(stream.cells(), sizeOfTest()), set), "fan");
}

} // namespace smg::testing
