// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Elements.h"
#include "Solver/Assembly/RowSums.h"
#include "Testing/Solver/SolveTesting.h"
#include "smg/CellWeights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

/** A flat grid of mostly obtuse triangles; the columns are the positions, prescribed at the border,
 * with initial values of zero. */
std::pair<StreamMesh, ArrayProblem> obtuseGrid()
{
  IndexedTestMesh indexed = grid(40, 40, 0.3);
  for (std::size_t k = 0; k < indexed.positions.size(); k += 3)
  {
    indexed.positions[k] += 2.0 * indexed.positions[k + 1];
  }
  const StreamMesh mesh = toStream(indexed);
  ArrayProblem problem;
  problem.Columns = 3;
  problem.Value = mesh.positions;
  problem.EdgeWeights = Weights::Cotangent;
  double low[2] = { 1e9, 1e9 };
  double high[2] = { -1e9, -1e9 };
  const auto along = [&](std::int64_t v, int axis)
  {
    const double y = mesh.positions[3 * v + 1];
    return axis == 1 ? y : mesh.positions[3 * v] - 2.0 * y;
  };
  for (std::int64_t v = 0; v < 2 * mesh.vertices(); ++v)
  {
    low[v % 2] = std::min(low[v % 2], along(v / 2, v % 2));
    high[v % 2] = std::max(high[v % 2], along(v / 2, v % 2));
  }
  problem.Prescribed.resize(mesh.vertices());
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (const int axis : { 0, 1 })
    {
      const double margin = 0.05 * (high[axis] - low[axis]);
      const double place = along(v, axis);
      problem.Prescribed[v] |= place < low[axis] + margin || place > high[axis] - margin;
    }
    std::fill_n(&problem.Value[3 * v], problem.Prescribed[v] ? 0 : 3, 0.0);
  }
  return { mesh, problem };
}

double errorOfLinear(const StreamMesh& mesh, ArrayProblem& problem)
{
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_TRUE(solved.report.converged);
  return (solved.values - positionsOf(mesh)).cwiseAbs().maxCoeff();
}

/** The mesh and 60 strips of one to five needles, each a component, with aspect ratios up to ten
 * thousand. */
IndexedTestMesh withCrumbs(IndexedTestMesh mesh)
{
  for (int crumb = 0; crumb < 60; ++crumb)
  {
    const double height = std::pow(10.0, -1.0 - crumb % 4);
    const std::int64_t triangles = 1 + crumb % 5;
    for (std::int64_t v = 0; v < triangles + 2; ++v)
    {
      const double at[3] = { 0.05 * crumb - 1.5 + 0.01 * static_cast<double>(v),
        v % 2 == 0 ? 0.0 : 0.01 * height, 0.0 };
      mesh.positions.insert(mesh.positions.end(), at, at + 3);
      if (v >= 2)
      {
        const std::int64_t last = mesh.vertices() - 1;
        mesh.corners.insert(mesh.corners.end(), { last - 2, last - 1, last });
      }
    }
  }
  return mesh;
}

} // namespace

TEST(RawWeights, KeepLinearFunctionsWhichClampedOnesDoNot)
{
  auto [mesh, problem] = obtuseGrid();
  const double extent = positionsOf(mesh).cwiseAbs().maxCoeff();
  EXPECT_LT(errorOfLinear(mesh, problem), 1e-5 * extent);
  problem.EdgeWeights = Weights::Clamped;
  EXPECT_GT(errorOfLinear(mesh, problem), 1e-3 * extent);
}

TEST(RawWeights, AgreeWithTheDirectSolve)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh =
      toStream(surface ? shuffled(torus(60, 20, 0.4)) : shuffled(tetBox(9, 8, 10, 0.3)));
    ArrayProblem problem = heldEnds(mesh, 2, Weights::Cotangent);
    const Solved solved = solveMesh(mesh, problem, accurate());
    EXPECT_TRUE(solved.report.converged);
    EXPECT_EQ(solved.report.clamped_weights, 0);
    EXPECT_LT((solved.values - solveDirectly(mesh, problem)).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(RawWeights, OfSliversConvergeHoweverFlatTheyAre)
{
  for (const double height : { 2e-2, 2e-3, 2e-4, 2e-5 })
  {
    const StreamMesh mesh = toStream(sliverChains(60, 48, height));
    ArrayProblem problem = heldEnds(mesh, 2, Weights::Cotangent);
    SolveOptions options = accurate(1e-12);
    options.inCore = true;
    const Solved solved = solveMesh(mesh, problem, options);
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LE(solved.report.passes, 20) << height;
    // Weights have single precision, and nearly cancel here.
    const Eigen::MatrixXd direct = solveDirectly(mesh, problem);
    EXPECT_LT((solved.values - direct).cwiseAbs().maxCoeff(), 1e-5 * direct.cwiseAbs().maxCoeff());

    options.inCore = false;
    options.coreNodes = 300;
    for (const auto& [threads, blockNodes] : { std::pair{ 1, 64 }, std::pair{ 2, 1000 } })
    {
      options.threads = threads;
      options.blockNodes = blockNodes;
      EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options).values, solved.values));
    }
  }
}

/** With one sweep, a patch may end in a block that is loaded after its first nodes are relaxed. */
TEST(RawWeights, OfSliversStreamWithOneSweep)
{
  const StreamMesh mesh = toStream(sliverChains(60, 48, 2e-3));
  ArrayProblem problem = heldEnds(mesh, 2, Weights::Cotangent);
  SolveOptions options = accurate();
  options.sweeps = 1;
  options.inCore = true;
  const Solved solved = solveMesh(mesh, problem, options);
  options.inCore = false;
  options.coreNodes = 300;
  for (const std::int64_t blockNodes : { 64, 1000 })
  {
    options.blockNodes = blockNodes;
    EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options).values, solved.values));
  }
}

/** Scans have debris: unconstrained components of a few needles. Only the mean of their initial
 * values is kept. */
TEST(RawWeights, OfFreeComponentsOfNeedlesConvergeAsFast)
{
  const IndexedTestMesh indexed = torus(60, 20, 0.4);
  const auto passesOf = [](const IndexedTestMesh& of)
  {
    const StreamMesh mesh = toStream(of);
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      problem.Value[v] = problem.Prescribed[v] ? problem.Value[v] : mesh.positions[3 * v + 1];
    }
    const Solved solved = solveMesh(mesh, problem, accurate(1e-10));
    EXPECT_TRUE(solved.report.converged);
    return solved.report.passes;
  };
  const std::int64_t passes = passesOf(indexed);
  EXPECT_LE(passesOf(withCrumbs(indexed)), passes + 7);
}

/** The screening on the diagonal of a needle is smaller than the rounding of the diagonal, but
 * alone determines the mean of its component: u = f / s. */
TEST(RawWeights, LittleScreeningDeterminesTheLevelOfNeedles)
{
  const StreamMesh mesh = toStream(withCrumbs(torus(60, 20, 0.4)));
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  problem.Screening = 1.0;
  problem.Prescribed.resize(mesh.vertices());
  problem.Value.resize(mesh.vertices());
  problem.Source.assign(mesh.vertices(), 3.0);
  const Solved solved = solveMesh(mesh, problem, accurate(1e-12));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_LT((solved.values.array() - 3.0).abs().maxCoeff(), 1e-7);
}

TEST(RawWeights, OfNothingButObtuseTrianglesLeaveASmallCoarsestLevel)
{
  IndexedTestMesh indexed = grid(220, 200);
  for (std::size_t k = 0; k < indexed.positions.size(); k += 3)
  {
    indexed.positions[k] += 6.0 * indexed.positions[k + 1];
  }
  const StreamMesh mesh = toStream(indexed);
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  const Report report = solveMesh(mesh, problem, accurate(1e-2)).report;
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.levels.back().nodes, 5500);
}

TEST(RawWeights, OfFlatCellsAreScaledDown)
{
  const double a[3] = { 0, 0, 0 };
  const double b[3] = { 1, 0, 0 };
  const double c[3] = { 0.4, 1e-8, 0 };
  const double* corners[4] = { a, b, c, nullptr };
  smg::CellWeights cell = triangleWeights(a, b, c);
  const double factor = flatnessFactor(CellType::Triangle, corners, cell);
  EXPECT_LT(factor, 1.0);
  double largest = 0.0;
  for (double& weight : cell.weight)
  {
    weight *= factor;
    largest = std::max(largest, std::fabs(weight));
  }
  EXPECT_NEAR(largest, 1e5, 1e-6);
  EXPECT_NEAR(flatnessFactor(CellType::Triangle, corners, cell), 1.0, 1e-12);
}

TEST(RawWeights, NeedlesKeepTheirs)
{
  // Rows of needles, as of a thin layer: -u'' = 1 along it, held at its lower end.
  const int rows = 21;
  IndexedTestMesh indexed = grid(21, rows);
  const double height = indexed.positions.end()[-2];
  for (std::size_t k = 0; k < indexed.positions.size(); k += 3)
  {
    indexed.positions[k] *= 3e-7;
  }
  const StreamMesh mesh = toStream(indexed);
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  problem.Value.resize(mesh.vertices(), 0.0);
  problem.Source.resize(mesh.vertices(), 1.0);
  problem.Prescribed.resize(mesh.vertices());
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    problem.Prescribed[v] = mesh.positions[3 * v + 1] < 0.5 ? 1 : 0;
  }
  const Solved solved = solveMesh(mesh, problem, accurate());
  EXPECT_TRUE(solved.report.converged);
  for (const std::string& note : solved.report.notes)
  {
    EXPECT_EQ(note.find("not that of finite elements"), std::string::npos) << note;
  }
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double y = mesh.positions[3 * v + 1];
    EXPECT_NEAR(solved.values(v, 0), height * y - 0.5 * y * y, 1e-3 * height * height);
  }
}

TEST(RawWeights, FlatCellsDoNotSpoilTheRest)
{
  auto [mesh, problem] = obtuseGrid();
  // A vertex in the middle moves almost onto the line through two of its neighbours.
  const std::size_t cells = mesh.corners.size() / 3;
  const std::int64_t* cell = &mesh.corners[3 * (cells / 2)];
  for (int d = 0; d < 3; ++d)
  {
    mesh.positions[3 * cell[0] + d] =
      0.5 * (mesh.positions[3 * cell[1] + d] + mesh.positions[3 * cell[2] + d]);
  }
  mesh.positions[3 * cell[0] + 1] += 1e-7;
  const Solved solved = solveMesh(mesh, problem, accurate(1e-8));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_TRUE(hasNote(solved.report, "so flat"));
  EXPECT_TRUE(solved.values.allFinite());
}

TEST(RawWeights, ANeedleBesideAPrescribedVertexDoesNotEndTheSolveEarly)
{
  // The first residual at the prescribed end of the needle is that of its weights, a million times
  // all others.
  const IndexedTestMesh indexed = gridWithNeedle(40, 40, 1e-6);
  const StreamMesh mesh = toStream(indexed);
  ArrayProblem problem;
  problem.Columns = 1;
  problem.EdgeWeights = Weights::Cotangent;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * static_cast<std::size_t>(v)];
    const bool isHot = p[0] == 20.0 && p[1] == 0.0;
    const bool isCold = p[1] == indexed.positions[3 * 40 * 39 + 1];
    problem.Prescribed.push_back(isHot || isCold);
    problem.Value.push_back(isHot ? 1.0 : 0.0);
  }
  const Solved solved = solveMesh(mesh, problem, accurate(1e-6));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_LT((solved.values - solveDirectly(mesh, problem)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(RawWeights, ARowThatRoundingHasLeftWithoutDiagonalIsRaised)
{
  constexpr double Large = 1e5 + 0.1; // in double precision
  const double cancelling[] = { Large, -Large, -0.1 };
  EXPECT_NEAR(lostDiagonal(cancelling, 0.0) - 0.1, 1e-8 * (2 * Large + 0.1), 1e-12);
  const double sound[] = { 2.0, -1.0 };
  EXPECT_EQ(lostDiagonal(sound, 0.0), 0.0);
  EXPECT_GT(lostDiagonal({}, 0.0), 0.0);
  const double small[] = { Large, -Large, 0.1 };
  EXPECT_EQ(lostDiagonal(small, 0.0), 0.0);
}

} // namespace smg::testing
