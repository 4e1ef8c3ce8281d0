// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Shi2006/Shi2006Testing.h"
#include "Testing/Benchmarks/Shi2006/VCycle.h"

#include <gtest/gtest.h>

// The result of a V-cycle of the equations of the paper.

namespace smg::testing
{
namespace
{

/** The values after a number of V-cycles, on a hierarchy of several levels. */
Eigen::MatrixXd valuesAfter(
  int cycles, const StreamMesh& mesh, ArrayProblem problem, int sweeps, double start = 0.0)
{
  AssembledLevel assembled(mesh, problem);
  shi2006::VCycle cycle(assembled.pool, assembled.level, sweeps, 20);
  EXPECT_GE(cycle.levels(), 4U);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; !problem.Prescribed[v] && k < problem.Columns; ++k)
    {
      assembled.level.value.at(v)[k] += start * std::cos(static_cast<double>(v + k));
    }
  }
  for (int c = 0; c < cycles; ++c)
  {
    cycle.run();
  }
  return rowsOf(assembled.level.value);
}

std::vector<StreamMesh> meshes()
{
  return { toStream(torus(60, 30, 0.3)), toStream(tetBox(12, 11, 10, 0.15)) };
}

} // namespace

TEST(Shi2006Cycle, DifferencesOfAFieldGiveTheFieldAtOnce)
{
  for (const StreamMesh& mesh : meshes())
  {
    for (const Weights weights : { Weights::Uniform, Weights::Clamped })
    {
      ArrayProblem problem = heldEndsOf(mesh, wavy, 2, weights);
      problem.Target = differencesOf(wavy, 2);
      Eigen::MatrixXd field(mesh.vertices(), 2);
      for (std::int64_t v = 0; v < mesh.vertices(); ++v)
      {
        field.row(v) << wavy(&mesh.positions[3 * v], 0), wavy(&mesh.positions[3 * v], 1);
      }
      for (const int sweeps : { 1, 2, 10 })
      {
        const Eigen::MatrixXd values = valuesAfter(1, mesh, problem, sweeps, 1.0);
        EXPECT_LT(relativeError(values, field), 1e-12) << sweeps;
      }
    }
  }
}

TEST(Shi2006Cycle, TheResultIsFinalAfterOneVCycleWhereverItBegan)
{
  for (const StreamMesh& mesh : meshes())
  {
    ArrayProblem problem = heldEndsOf(mesh, wavy, 3, Weights::Uniform);
    problem.Target = scaledEdges(3);
    for (const int sweeps : { 1, 3 })
    {
      const Eigen::MatrixXd once = valuesAfter(1, mesh, problem, sweeps);
      EXPECT_LT(relativeError(valuesAfter(12, mesh, problem, sweeps), once), 1e-12);
      EXPECT_LT(relativeError(valuesAfter(1, mesh, problem, sweeps, 5.0), once), 1e-12);
      EXPECT_GT(relativeError(valuesAfter(0, mesh, problem, sweeps), once), 0.1);
    }
  }
}

TEST(Shi2006Cycle, TheResultIsNotTheSolution)
{
  for (const StreamMesh& mesh : meshes())
  {
    for (const bool harmonic : { true, false })
    {
      ArrayProblem problem = heldEndsOf(mesh, wavy, 3, Weights::Uniform);
      problem.Target = harmonic ? ArrayProblem::EdgeTarget{} : scaledEdges(3);
      const Eigen::MatrixXd solution = solveDirectly(mesh, problem);
      double before = 0.4;
      for (const int sweeps : { 1, 3, 10 })
      {
        const double bias = relativeError(valuesAfter(1, mesh, problem, sweeps), solution);
        EXPECT_LT(bias, before) << sweeps;
        EXPECT_GT(bias, 0.005) << sweeps;
        before = bias;
      }
    }
  }
}

TEST(Shi2006Cycle, PartsThatNoConstraintReachesStayFinite)
{
  // A free triangle with a source, beside two that share a prescribed vertex.
  const StreamMesh mesh{ CellType::Triangle,
    { 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0 },
    { 0, 1, 2, 0, 3, 4, 5, 6, 7 }, {}, {}, {} };
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Uniform;
  problem.Prescribed = { 1, 0, 0, 0, 0, 0, 0, 0 };
  problem.Value = { 4, 0, 0, 0, 0, 0, 0, 0 };
  problem.Source = { 0, 0, 0, 0, 0, 1, 0, 0 };
  AssembledLevel assembled(mesh, problem);
  shi2006::VCycle cycle(assembled.pool, assembled.level, 1);
  ASSERT_EQ(cycle.level(1).nodes(), 3);
  EXPECT_EQ(cycle.level(1).node[2].diagonal, 0.0);
  cycle.run();
  const Eigen::MatrixXd values = rowsOf(assembled.level.value);
  EXPECT_TRUE(values.allFinite());
  for (int v = 0; v < 5; ++v)
  {
    EXPECT_NEAR(values(v), 4.0, 1e-14);
  }
}

} // namespace smg::testing
