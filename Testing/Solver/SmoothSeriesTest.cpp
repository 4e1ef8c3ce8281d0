// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SmoothTesting.h"
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

// Steps of a column share a hierarchy: each begins in the pass that ends the one before.

namespace smg::testing
{
namespace
{

/** A mesh of several blocks of rows with a column "noise" of `columns` numbers around `offset`, and
 * two vertices without cells at its end. */
StreamMesh withNoise(StreamMesh mesh, int columns, double offset = 0.0)
{
  Random random(11);
  for (const double place : { -3.0, -4.0 })
  {
    mesh.positions.insert(mesh.positions.end(), { place, place, 0.0 });
  }
  std::vector<double> noise(static_cast<std::size_t>(columns * mesh.vertices()));
  std::ranges::generate(noise, [&] { return offset + random.uniform(-1.0, 1.0); });
  mesh.vertexColumns = { makeColumn<double>("noise", noise, columns) };
  return mesh;
}

Eigen::MatrixXd noiseOf(const StreamMesh& mesh)
{
  const Column& column = mesh.vertexColumns.front();
  Eigen::MatrixXd u(mesh.vertices(), column.spec.components);
  for (Eigen::Index v = 0; v < u.rows(); ++v)
  {
    for (Eigen::Index k = 0; k < u.cols(); ++k)
    {
      u(v, k) = column.value(static_cast<std::size_t>(v), static_cast<int>(k));
    }
  }
  return u;
}

Smoothing series(int steps, double size = 6.0)
{
  Smoothing options = plainStep(size);
  options.column = "noise";
  options.steps = steps;
  return options;
}

std::vector<StreamMesh> meshes()
{
  return { withNoise(noisy(toStream(grid(71, 45)), 0.25), 1),
    withNoise(toStream(tetBox(14, 13, 12, 0.2)), 3) };
}

} // namespace

TEST(SmoothSeries, StepsAreThoseOfTheDirectSolve)
{
  for (const StreamMesh& mesh : meshes())
  {
    Smoothing options = series(4);
    options.hold = { Region::Vertices{ { 0, 7, 900, 1500 } } };
    std::vector<std::uint8_t> held(static_cast<std::size_t>(mesh.vertices()));
    for (const std::size_t v : { 0, 7, 900, 1500 })
    {
      held[v] = 1;
    }
    // Nothing determines these: they keep their values.
    held[held.size() - 1] = held[held.size() - 2] = 1;
    const Eigen::MatrixXd points = pointsOf(mesh);
    const Eigen::VectorXd mass = lumpedMass(mesh, points);
    const Eigen::SparseMatrix<double> L = stiffness(mesh, points);
    Eigen::MatrixXd expected = noiseOf(mesh);
    for (int k = 0; k < 4; ++k)
    {
      expected = smoothDirectly(mass, L, timeOf(6.0, 4), expected, held);
    }
    const Solved result = smoothed(mesh, options);
    EXPECT_LT((result.values - expected).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_TRUE(result.report.converged);
    ASSERT_EQ(result.report.steps.size(), 4U);
    EXPECT_EQ(result.report.steps[2].name, "step 3");
    EXPECT_TRUE(result.values.bottomRows(2) == noiseOf(mesh).bottomRows(2));
    EXPECT_TRUE(result.values.row(900) == noiseOf(mesh).row(900));
  }
}

TEST(SmoothSeries, HasTheSameBitsInCoreWithAnyThreadsAndBlocks)
{
  for (const StreamMesh& mesh : meshes())
  {
    Smoothing options = series(3);
    options.coreNodes = 100;
    const Solved expected = smoothed(mesh, options);
    for (const int threads : { 1, 2, 5 })
    {
      for (const bool inCore : { false, true })
      {
        options.threads = threads;
        options.inCore = inCore;
        const Solved result = smoothed(mesh, options, threads == 2 ? 37 : 5000);
        EXPECT_TRUE(sameBits(result.values, expected.values)) << threads << ' ' << inCore;
        EXPECT_EQ(result.report.residuals, expected.report.residuals);
      }
    }
  }
}

TEST(SmoothSeries, AStepTakesAPassForEachVCycle)
{
  // The survey and the first pass come before, the rest of the last V-cycle after.
  for (const int steps : { 1, 2, 5 })
  {
    for (const int cycles : { 1, 3 })
    {
      Smoothing options = series(steps);
      options.maxCycles = cycles;
      options.tolerance = 1e-13;
      const Solved result = smoothed(meshes()[0], options);
      EXPECT_EQ(result.report.passes, 2 + steps * cycles);
      EXPECT_EQ(result.report.cycles, steps * cycles);
      EXPECT_FALSE(result.report.converged);
      EXPECT_TRUE(std::ranges::all_of(
        result.report.residuals, [](double residual) { return residual > 0.0 && residual < 0.1; }));
    }
  }
}

TEST(SmoothSeries, KeepsTheMeanOfAMeshThatIsSmallBesideTheSize)
{
  // The masses hold the mesh so loosely that its mean is not among what is iterated.
  const double offset = 1e4;
  const StreamMesh mesh = withNoise(noisy(toStream(grid(71, 45)), 0.25), 1, offset);
  const Eigen::VectorXd mass = lumpedMass(mesh, pointsOf(mesh));
  const double mean = mass.dot(noiseOf(mesh).col(0)) / mass.sum();
  for (const int steps : { 1, 4 })
  {
    const Eigen::MatrixXd values = smoothed(mesh, series(steps, 1e8)).values;
    const auto onMesh = values.topRows(values.rows() - 2).array();
    EXPECT_LT((onMesh - mean).abs().maxCoeff(), 1e-8 * offset) << steps;
  }
}

} // namespace smg::testing
