// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/Sanitized.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace smg::testing
{
namespace
{

/** Solves out of core and in core, which must agree bit for bit, and directly. */
Solved solveInAllWays(const StreamMesh& mesh, ArrayProblem problem, double tolerance = 1e-10)
{
  SolveOptions options = accurate(tolerance);
  const Solved streaming = solveMesh(mesh, problem, options);
  options.inCore = true;
  const Solved core = solveMesh(mesh, problem, options);
  EXPECT_TRUE(sameBits(streaming.values, core.values));
  options.inCore = false;
  options.coreNodes = 0;
  options.blockNodes = 1;
  EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options, 1).values, core.values));
  EXPECT_TRUE(streaming.report.converged);
  EXPECT_LT(relativeError(streaming.values, solveDirectly(mesh, problem)), 1e-7);
  return streaming;
}

/** A hub with a ring of `triangles` triangles around it. */
IndexedTestMesh fan(std::int64_t triangles)
{
  IndexedTestMesh mesh{ CellType::Triangle, { 0, 0, 0.1 }, {} };
  for (std::int64_t k = 0; k < triangles; ++k)
  {
    const double angle =
      2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(triangles);
    const double radius = 1.0 + 0.3 * std::sin(5 * angle);
    mesh.positions.insert(
      mesh.positions.end(), { radius * std::cos(angle), radius * std::sin(angle), 0.0 });
    mesh.corners.insert(mesh.corners.end(), { 0, 1 + k, 1 + (k + 1) % triangles });
  }
  return mesh;
}

} // namespace

TEST(SpecialMeshes, AllVerticesPrescribed)
{
  for (const bool surface : { true, false })
  {
    const StreamMesh mesh = toStream(surface ? torus(60, 40) : tetBox(8, 8, 8));
    ArrayProblem problem = heldEnds(mesh, 2, Weights::Clamped);
    std::fill(problem.Prescribed.begin(), problem.Prescribed.end(), 1);
    Random random(1);
    for (double& value : problem.Value)
    {
      value = random.uniform();
    }
    const Solved solved = solveInAllWays(mesh, problem);
    EXPECT_EQ(solved.report.prescribed, mesh.vertices());
    EXPECT_EQ(solved.report.levels[0].nodes, 0);
    EXPECT_EQ(solved.report.cycles, 0);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      EXPECT_EQ(solved.values(v, 1), problem.Value[2 * v + 1]);
    }
  }
}

TEST(SpecialMeshes, ASingleTriangle)
{
  const StreamMesh mesh{ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 2, 0 }, { 0, 1, 2 }, {}, {},
    {} };
  ArrayProblem problem;
  problem.Prescribed = { 1, 0, 0 };
  problem.Value = { 5, 0, 1 };
  problem.Source = { 1, -2, 3 };
  for (const Weights weights : { Weights::Uniform, Weights::Clamped })
  {
    problem.EdgeWeights = weights;
    solveInAllWays(mesh, problem);
  }
  problem.Prescribed = {};
  solveInAllWays(mesh, problem);
}

TEST(SpecialMeshes, ASingleTetrahedron)
{
  const StreamMesh mesh{ CellType::Tetrahedron, { 0, 0, 0, 1, 0, 0, 0, 2, 0, 0.1, 0.2, 1 },
    { 0, 1, 2, 3 }, {}, {}, {} };
  ArrayProblem problem;
  problem.Prescribed = { 1, 0, 0, 1 };
  problem.Value = { 5, 0, 1, -2 };
  problem.Source = { 1, -2, 3, 0 };
  solveInAllWays(mesh, problem);
}

TEST(SpecialMeshes, OneVertexPrescribed)
{
  const StreamMesh mesh = toStream(torus(100, 50, 0.3));
  ArrayProblem problem;
  problem.Prescribed.resize(mesh.vertices());
  problem.Prescribed[mesh.vertices() / 3] = 1;
  problem.Value.resize(mesh.vertices());
  problem.Value[mesh.vertices() / 3] = 4.0;
  const Solved constant = solveMesh(mesh, problem, accurate());
  EXPECT_TRUE(constant.report.converged);
  EXPECT_LT((constant.values.array() - 4.0).abs().maxCoeff(), 1e-6);

  problem.Source.resize(mesh.vertices());
  Random random(8);
  for (double& source : problem.Source)
  {
    source = random.uniform(-1, 1);
  }
  solveInAllWays(mesh, problem, 1e-12);
}

TEST(SpecialMeshes, HeldVerticesKeepTheirValue)
{
  StreamMesh mesh = toStream(grid(20, 20));
  const std::int64_t before = mesh.vertices();
  mesh.positions.insert(mesh.positions.end(), { 50, 0, 0, 51, 0, 0, 52, 0, 0, 60, 0, 0 });
  // A cell without area, and one with a repeated corner.
  mesh.corners.insert(
    mesh.corners.end(), { before, before + 1, before + 2, before + 3, before + 3, 3 });
  for (const double screening : { 0.0, 1.0 })
  {
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
    std::fill(problem.Prescribed.begin() + before, problem.Prescribed.end(), 0);
    std::copy_n(std::vector<double>{ 7, 8, 9, 10 }.begin(), 4, problem.Value.begin() + before);
    problem.Screening = screening;
    const Solved solved = solveInAllWays(mesh, problem);
    EXPECT_EQ(solved.report.held, 4);
    EXPECT_EQ(solved.report.degenerate_cells, 2);
    EXPECT_EQ(solved.report.levels[0].nodes, mesh.vertices() - 4 - solved.report.prescribed);
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(solved.values(before + k), 7 + k);
    }
  }
}

TEST(SpecialMeshes, OnlyDegenerateCells)
{
  const StreamMesh mesh{ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 2, 0, 0 }, { 0, 1, 2, 0, 0, 1 },
    {}, {}, {} };
  ArrayProblem problem;
  problem.Value = { 1, 2, 3 };
  problem.Source = { 5, 5, 5 };
  const Solved solved = solveMesh(mesh, problem);
  EXPECT_EQ(solved.report.held, 3);
  EXPECT_EQ(solved.report.degenerate_cells, 2);
  EXPECT_EQ(solved.values, (Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE(solved.report.converged);
}

TEST(SpecialMeshes, FlaggedCellsCarryNoWeight)
{
  StreamMesh clean = toStream(torus(40, 20, 0.2));
  const ArrayProblem problem = heldEnds(clean, 1, Weights::Clamped);
  StreamMesh doubled = clean;
  std::vector<std::uint8_t> flags;
  doubled.corners.clear();
  for (std::int64_t c = 0; c < clean.cells(); ++c)
  {
    const std::int64_t* cell = &clean.corners[3 * c];
    doubled.corners.insert(doubled.corners.end(), cell, cell + 3);
    flags.push_back(0);
    if (c % 5 == 0)
    {
      doubled.corners.insert(doubled.corners.end(), { cell[2], cell[1], cell[0] });
      flags.push_back(c % 2 ? DuplicateCell : DegenerateCell | DuplicateCell);
    }
  }
  doubled.cellColumns = { makeColumn<std::uint8_t>(
                            "Other", std::vector<std::uint8_t>(flags.size(), 1)),
    makeColumn<std::uint8_t>(CellFlagsName, flags) };
  const Solved expected = solveInAllWays(clean, problem);
  const Solved solved = solveInAllWays(doubled, problem);
  EXPECT_TRUE(sameBits(solved.values, expected.values));
  EXPECT_EQ(solved.report.degenerate_cells, (clean.cells() + 4) / 5);
  EXPECT_EQ(solved.report.cells, doubled.cells());
}

TEST(SpecialMeshes, DuplicatesWithoutFlagAddTheirWeight)
{
  StreamMesh mesh = toStream(torus(40, 20, 0.2));
  const auto corners = mesh.corners;
  mesh.corners.insert(mesh.corners.end(), corners.begin() + 300, corners.begin() + 600);
  solveInAllWays(mesh, heldEnds(mesh, 1, Weights::Clamped));
  solveInAllWays(mesh, heldEnds(mesh, 1, Weights::Uniform));
}

TEST(SpecialMeshes, ANonManifoldEdge)
{
  // Three sheets with a common line.
  IndexedTestMesh mesh = grid(20, 20);
  const std::int64_t vertices = mesh.vertices();
  for (std::int64_t j = 0; j < 20; ++j)
  {
    mesh.positions.insert(mesh.positions.end(),
      { mesh.positions[3 * (20 * j + 10)], mesh.positions[3 * (20 * j + 10) + 1], 1.0 });
    if (j > 0)
    {
      const std::int64_t low = 20 * (j - 1) + 10;
      const std::int64_t high = 20 * j + 10;
      mesh.corners.insert(mesh.corners.end(), { low, high, vertices + j });
      mesh.corners.insert(mesh.corners.end(), { low, vertices + j, vertices + j - 1 });
    }
  }
  const StreamMesh stream = toStream(mesh);
  solveInAllWays(stream, heldEnds(stream, 2, Weights::Clamped));
}

TEST(SpecialMeshes, SliversDoNotBreakConvergence)
{
  // A sphere flattened to a needle: its triangles have angles down to a fraction of a degree.
  IndexedTestMesh needle = sphere(5);
  for (std::size_t i = 0; i < needle.positions.size(); i += 3)
  {
    needle.positions[i] *= 0.01;
  }
  const StreamMesh mesh = toStream(needle);
  const Solved solved =
    solveMesh(mesh, *std::make_unique<ArrayProblem>(fixedEnds(mesh)), accurate(1e-6));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_TRUE(std::isfinite(solved.values.sum()));
}

TEST(SpecialMeshes, AHubOfVeryManyTriangles)
{
  // Of more triangles than numbers of 16 bits.
  const IndexedTestMesh mesh = fan(Sanitized ? 7000 : 70000);
  for (const TestOrder order : { TestOrder::Keep, TestOrder::BreadthFirst })
  {
    const StreamMesh stream = toStream(order == TestOrder::Keep ? shuffled(mesh) : mesh, order);
    ArrayProblem problem = heldEnds(stream, 1, Weights::Uniform);
    problem.Source.assign(stream.vertices(), 0.3);
    solveInAllWays(stream, problem);
  }
}

TEST(SpecialMeshes, AHubThatIsPrescribed)
{
  const StreamMesh mesh = toStream(fan(5000));
  ArrayProblem problem;
  problem.Prescribed.resize(mesh.vertices());
  problem.Value.resize(mesh.vertices());
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    problem.Prescribed[v] = mesh.originalIds[v] == 0 || mesh.originalIds[v] == 2000;
    problem.Value[v] = mesh.originalIds[v] == 2000 ? 1.0 : 0.0;
  }
  problem.EdgeWeights = Weights::Uniform;
  solveInAllWays(mesh, problem);
}

TEST(SpecialMeshes, ScaleAndPlaceDoNotMatter)
{
  // Scaling by a power of two does not change the cotangent weights of a surface at all.
  IndexedTestMesh mesh = torus(60, 30, 0.3);
  const StreamMesh plain = toStream(mesh);
  for (double& p : mesh.positions)
  {
    p *= 0x1p-40;
  }
  const StreamMesh small = toStream(mesh);
  ArrayProblem problem = heldEnds(plain, 1, Weights::Clamped);
  EXPECT_TRUE(sameBits(solveMesh(small, problem).values, solveMesh(plain, problem).values));
}

} // namespace smg::testing
