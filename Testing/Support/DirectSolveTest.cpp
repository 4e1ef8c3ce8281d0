// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/MemorySource.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

DirectSystem assemble(const StreamMesh& mesh, Problem& problem)
{
  MemorySource source(mesh, 37);
  return assembleDirect(source, problem);
}

/** The positions of all vertices, one row per vertex. */
Eigen::MatrixXd positionsOf(const StreamMesh& mesh)
{
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
    mesh.positions.data(), mesh.vertices(), 3);
}

/** The positions as initial values, prescribed where `isFixed(x, y, z)`. */
template <class Predicate>
ArrayProblem positionProblem(const StreamMesh& mesh, Predicate isFixed)
{
  ArrayProblem problem = fixedEnds(mesh, 0.0, true);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    problem.Prescribed[v] = isFixed(p[0], p[1], p[2]);
  }
  return problem;
}

} // namespace

TEST(DirectSolve, CotangentReproducesLinearFunctionsOnAFlatMesh)
{
  const StreamMesh mesh = toStream(shuffled(grid(14, 12, 0.08)));
  ArrayProblem problem = positionProblem(
    mesh, [](double x, double y, double) { return x < 1 || x > 12.4 || y < 0.5 || y > 9; });
  ArrayProblem fromZero = problem;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < 3 && !problem.Prescribed[v]; ++k)
    {
      fromZero.Value[3 * v + k] = 0;
    }
  }
  const DirectSystem system = assemble(mesh, fromZero);
  EXPECT_EQ(system.clampedWeights, 0);
  EXPECT_LT(relativeError(solveDirect(system), positionsOf(mesh)), 1e-13);
}

TEST(DirectSolve, StiffnessReproducesLinearFunctionsInTetrahedra)
{
  const StreamMesh mesh = toStream(tetBox(6, 5, 7));
  const auto onBoundary = [](double x, double y, double z)
  { return x == 0 || x == 5 || y == 0 || y == 4 || z == 0 || z == 6; };
  ArrayProblem problem = positionProblem(mesh, onBoundary);
  const DirectSystem system = assemble(mesh, problem);
  EXPECT_EQ(system.unknowns(), 4 * 3 * 5);
  EXPECT_NEAR(system.mass.sum(), 5 * 4 * 6, 1e-12);
  EXPECT_LT(relativeError(solveDirect(system), positionsOf(mesh)), 1e-13);
}

TEST(DirectSolve, EigenfunctionOfTheSphere)
{
  // On the unit sphere -Laplace(z) = 2 z, so the solution for the source 2 z + s z is z.
  const StreamMesh mesh = toStream(sphere(4));
  for (const double screening : { 0.0, 3.0 })
  {
    ArrayProblem problem;
    problem.Screening = screening;
    problem.Source.resize(mesh.vertices());
    Eigen::MatrixXd expected(mesh.vertices(), 1);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      expected(v) = mesh.positions[3 * v + 2];
      problem.Source[v] = (2 + screening) * expected(v);
    }
    const DirectSystem system = assemble(mesh, problem);
    EXPECT_EQ(system.isFloating, std::vector<std::uint8_t>{ screening == 0.0 });
    EXPECT_NEAR(system.mass.sum(), 4 * M_PI, 0.05);
    EXPECT_LT(relativeError(solveDirect(system), expected), 2e-3);
  }
}

TEST(DirectSolve, EdgeTargetsRestoreTheirPotential)
{
  const StreamMesh mesh = toStream(torus(30, 14, 0.2));
  ArrayProblem problem = positionProblem(mesh, [](double x, double, double) { return x > 2.7; });
  std::fill(problem.Value.begin(), problem.Value.end(), 0.0);
  Eigen::MatrixXd expected = positionsOf(mesh);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < 3 && problem.Prescribed[v]; ++k)
    {
      problem.Value[3 * v + k] = expected(v, k);
    }
  }
  problem.Target = [](const double* p, const double* q, double* d)
  { std::transform(p, p + 3, q, d, std::minus<>()); };
  EXPECT_LT(relativeError(solveDirect(assemble(mesh, problem)), expected), 1e-12);
}

TEST(DirectSolve, FloatingComponentsKeepTheirMean)
{
  const IndexedTestMesh one = torus(20, 10);
  const StreamMesh mesh = toStream(disjointUnion(one, one, { 0, 0, 9 }));
  ArrayProblem problem = positionProblem(mesh, [](double, double, double z) { return z < -0.9; });
  problem.EdgeWeights = Weights::Uniform;
  const DirectSystem system = assemble(mesh, problem);
  ASSERT_EQ(system.isFloating.size(), 2);
  EXPECT_EQ(system.isFloating[0] + system.isFloating[1], 1);
  const Eigen::MatrixXd x = solveDirect(system);
  EXPECT_LT(system.relativeResidual(x), 1e-12);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    if (mesh.positions[3 * v + 2] > 5)
    {
      EXPECT_NEAR(x(v, 2), 9.0, 1e-10);
      EXPECT_NEAR(x(v, 0), 0.0, 1e-10);
    }
  }
}

TEST(DirectSolve, DegenerateAndFlaggedCellsCarryNoWeight)
{
  StreamMesh mesh;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 5, 5, 5 };
  mesh.corners = { 0, 1, 2, 0, 1, 3, 3, 3, 1, 0, 1, 2, 1, 2, 4 };
  const std::uint8_t flags[] = { 0, 0, 0, DuplicateCell, DegenerateCell };
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  ArrayProblem problem;
  problem.Prescribed = { 1, 0, 0, 0, 0 };
  const DirectSystem system = assemble(mesh, problem);
  EXPECT_EQ(system.degenerateCells, 4);
  EXPECT_EQ(system.held, 2);
  EXPECT_EQ(system.unknowns(), 2);
  // The edge opposite to the right angle is clamped.
  EXPECT_EQ(system.clampedWeights, 1);
  EXPECT_DOUBLE_EQ(system.matrix.coeff(0, 1), -5e-4);
  EXPECT_DOUBLE_EQ(system.matrix.coeff(0, 0), 0.5 + 5e-4);
}

} // namespace smg::testing
