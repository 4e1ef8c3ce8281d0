// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/InteractiveDeformation.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemoryMesh.h"
#include "smg/DescribedProblem.h"
#include "smg/Smooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// Meshes without vertices, without cells, and with isolated vertices.

namespace smg::testing
{
namespace
{

/** A row of vertices, of which the first three form a triangle if `hasCell`. */
StreamMesh rowOf(int vertices, bool hasCell)
{
  StreamMesh mesh;
  mesh.positions.resize(3 * static_cast<std::size_t>(vertices));
  for (int v = 0; v < vertices; ++v)
  {
    mesh.positions[3 * v] = v;
    mesh.positions[3 * v + 1] = 0.5 * v * v;
  }
  if (hasCell)
  {
    mesh.corners = { 0, 1, 2 };
  }
  return mesh;
}

/** Holds the given vertices with a motion. */
ArrayHandles holding(
  const StreamMesh& mesh, const std::vector<std::int64_t>& held, const Motion& motion)
{
  ArrayHandles handles(mesh.vertices());
  std::int64_t v = 0;
  handles.hold(
    mesh,
    [&](const Eigen::Vector3d&) { return std::find(held.begin(), held.end(), v++) != held.end(); },
    motion);
  return handles;
}

/** By tolerance and with a fixed number of cycles, both out of core and in core. */
std::vector<DeformOptions> deformWays()
{
  std::vector<DeformOptions> ways;
  for (const int cycles : { 0, 1, 2 })
  {
    for (const bool core : { false, true })
    {
      ways.push_back(withCycles(cycles));
      ways.back().inCore = core;
    }
  }
  return ways;
}

/** Checks that the vertices are within `slack` of `expected` for all options. */
void expectDeformed(
  const StreamMesh& mesh, ArrayHandles& handles, const Eigen::MatrixXd& expected, double slack)
{
  for (const DeformOptions& options : deformWays())
  {
    SCOPED_TRACE(std::to_string(options.cycles) + (options.inCore ? " cycles in core" : " cycles"));
    const Solved solved = deformMesh(mesh, handles, options);
    ASSERT_EQ(solved.values.rows(), mesh.vertices());
    EXPECT_LE((solved.values - expected).cwiseAbs().maxCoeff(), slack);
    EXPECT_TRUE(solved.report.converged);
    MemorySource source(mesh);
    InteractiveDeformation interactive(source, handles, options);
    EXPECT_TRUE(sameBits(valuesOf(interactive), solved.values));
    EXPECT_TRUE(interactive.update(handles.Values));
    EXPECT_TRUE(sameBits(valuesOf(interactive), solved.values));
  }
}

Motion quarterTurn()
{
  Motion motion = turn(90.0, { 0, 0, 1 });
  motion.translation = { 1, 2, 3 };
  return motion;
}

} // namespace

TEST(EmptyMeshes, WithoutVerticesAreAnError)
{
  const StreamMesh mesh = rowOf(0, false);
  ArrayProblem problem;
  ArrayHandles handles(0);
  for (const bool core : { false, true })
  {
    SolveOptions solving;
    solving.inCore = core;
    expectError([&] { solveMesh(mesh, problem, solving); }, "no vertices");
    DeformOptions deforming = withCycles(2);
    deforming.inCore = core;
    expectError([&] { deformMesh(mesh, handles, deforming); }, "no vertices");
  }
  MemorySource source(mesh);
  expectError([&] { InteractiveDeformation(source, handles, withCycles(2)); }, "no vertices");
}

TEST(EmptyMeshes, VerticesWithoutCellsKeepTheirValues)
{
  for (const bool hasCell : { false, true })
  {
    for (const int vertices : { 1, 5 })
    {
      if (hasCell && vertices < 3)
      {
        continue;
      }
      const StreamMesh mesh = rowOf(vertices, hasCell);
      ArrayProblem problem;
      problem.Value.resize(vertices);
      problem.Prescribed.assign(vertices, 0);
      for (int v = 0; v < vertices; ++v)
      {
        problem.Value[v] = 7.0 + v;
      }
      // One vertex of the triangle is prescribed, so that the others take its value.
      problem.Prescribed[0] = 1;
      for (const bool core : { false, true })
      {
        SolveOptions options = accurate();
        options.inCore = core;
        const Solved solved = solveMesh(mesh, problem, options);
        ASSERT_EQ(solved.values.rows(), vertices);
        for (int v = 0; v < vertices; ++v)
        {
          EXPECT_NEAR(solved.values(v, 0), hasCell && v < 3 ? 7.0 : 7.0 + v, 1e-9);
        }
        EXPECT_TRUE(solved.report.converged);
        EXPECT_EQ(solved.report.prescribed, 1);
        EXPECT_EQ(solved.report.held, hasCell ? vertices - 3 : vertices - 1);
      }
    }
  }
}

/** A triangle, and vertices 3, 4 and 5 of a flat cell or no cell. */
StreamMesh withoutWeights(bool hasFlatCell)
{
  StreamMesh mesh = rowOf(6, true);
  if (hasFlatCell)
  {
    std::copy_n(mesh.positions.begin() + 9, 3, mesh.positions.begin() + 12);
    mesh.corners.insert(mesh.corners.end(), { 2, 3, 4 });
  }
  return mesh;
}

/** The solution on that with vertices 0 and 5 prescribed. */
Solved solveWithoutWeights(bool hasFlatCell, SolveOptions options)
{
  const StreamMesh mesh = withoutWeights(hasFlatCell);
  ProblemDescription description;
  description.dirichlet = { { Region(Region::Vertices{ { 0, 5 } }), 2.0 } };
  DescribedProblem problem(description, MemorySource(mesh).info());
  return solveMesh(mesh, problem, options);
}

TEST(EmptyMeshes, ADescribedSolutionIsNotANumberWhereNothingDeterminesIt)
{
  for (const bool hasFlatCell : { false, true })
  {
    SolveOptions streamed = accurate(), inCore = accurate();
    inCore.inCore = true;
    const Solved first = solveWithoutWeights(hasFlatCell, streamed);
    for (int v = 0; v < 6; ++v)
    {
      const bool isDetermined = v < 3 || v == 5;
      EXPECT_EQ(std::isnan(first.values(v, 0)), !isDetermined) << v;
      EXPECT_TRUE(!isDetermined || std::fabs(first.values(v, 0) - 2.0) < 1e-9) << v;
    }
    EXPECT_EQ(first.report.held, 2);
    EXPECT_EQ(first.report.warnings.size(), hasFlatCell ? 2U : 1U);
    EXPECT_TRUE(sameBits(first.values, solveWithoutWeights(hasFlatCell, inCore).values));
  }
}

TEST(EmptyMeshes, WhatMovesKeepsWhatNothingDeterminesAndWarnsOnce)
{
  const StreamMesh mesh = withoutWeights(true);
  Smoothing smoothing;
  smoothing.boundary = SmoothedBoundary::Free;
  smoothing.steps = 2;
  const MemoryMesh whole(mesh);
  const std::unique_ptr<Solution> smoothed = smooth(whole, smoothing, smoothing);
  const Eigen::MatrixXd values = valuesOf(*smoothed);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(values(4, axis), mesh.positions[static_cast<std::size_t>(3 * 4 + axis)]);
  }
  EXPECT_EQ(smoothed->report().warnings.size(), 2U);
  ArrayHandles handles = holding(mesh, { 0 }, quarterTurn());
  MemorySource source(mesh);
  InteractiveDeformation deformation(source, handles, withCycles(2));
  const std::size_t warnings = deformation.report().warnings.size();
  EXPECT_GE(warnings, 2U);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(deformation.report().warnings.size(), warnings);
    ASSERT_TRUE(deformation.update(handles.Values));
  }
}

TEST(EmptyMeshes, ASingleVertexGoesWhereItsHandleSays)
{
  const StreamMesh mesh = rowOf(1, false);
  ArrayHandles held = holding(mesh, { 0 }, quarterTurn());
  expectDeformed(mesh, held, moved(mesh, quarterTurn()), 0.0);
  ArrayHandles free(1);
  expectError([&] { deformMesh(mesh, free); }, "nothing to deform");
}

TEST(EmptyMeshes, VerticesWithoutCellsStayUnlessTheyAreHeld)
{
  for (const bool hasCell : { false, true })
  {
    const StreamMesh mesh = rowOf(6, hasCell);
    const Eigen::MatrixXd turned = moved(mesh, quarterTurn());
    // Only the last vertex is held: the free triangle does not move.
    ArrayHandles last = holding(mesh, { 5 }, quarterTurn());
    Eigen::MatrixXd expected = positionsOf(mesh);
    expected.row(5) = turned.row(5);
    expectDeformed(mesh, last, expected, 0.0);
    // A held vertex of the triangle moves all of it.
    ArrayHandles two = holding(mesh, { 1, 4 }, quarterTurn());
    expected = positionsOf(mesh);
    expected.row(4) = turned.row(4);
    expected.row(1) = turned.row(1);
    if (hasCell)
    {
      expected.topRows(3) = turned.topRows(3);
    }
    expectDeformed(mesh, two, expected, 1e-9);
    ArrayHandles all = holding(mesh, { 0, 1, 2, 3, 4, 5 }, quarterTurn());
    expectDeformed(mesh, all, turned, 0.0);
  }
}

} // namespace smg::testing
