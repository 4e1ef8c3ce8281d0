// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Testing/Solver/CycleTesting.h"
#include "Testing/Support/Combinations.h"

#include <gtest/gtest.h>

namespace smg::testing
{
namespace
{

std::vector<Level<float>*> levelsOf(DenseHierarchy<>& h, int levels)
{
  std::vector<Level<float>*> list{ &h.finest() };
  for (int l = 1; l < levels; ++l)
  {
    list.push_back(&h.coarse(l));
  }
  return list;
}

/** One V-cycle from zero, by dense linear algebra. */
Eigen::MatrixXd denseCycle(const DenseHierarchy<>& h, int levels, int l, const Eigen::MatrixXd& b)
{
  constexpr int Sweeps = 2;
  const Eigen::MatrixXd& a = h.matrix(l);
  if (l + 1 == levels)
  {
    return a.ldlt().solve(b);
  }
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(b.rows(), b.cols());
  for (int sweep = 0; sweep < Sweeps; ++sweep)
  {
    denseSweep(a, sweep == 0 ? h.patches(l) : PatchList{}, b, x);
  }
  const Eigen::MatrixXd p = h.interpolation(l);
  x += p * denseCycle(h, levels, l + 1, p.transpose() * (b - a * x));
  for (int sweep = 0; sweep < Sweeps; ++sweep)
  {
    denseSweep(a, sweep == 0 ? h.patches(l) : PatchList{}, b, x);
  }
  return x;
}

} // namespace

TEST(CoreVCycle, IsTheVCycle)
{
  Combinations combinations;
  const TestLevel surface =
    finestLevel(toStream(shuffled(torus(50, 24, 0.4))), Weights::Clamped, 100);
  const TestLevel solid = finestLevel(toStream(shuffled(tetBox(9, 9, 9))), Weights::Uniform, 100);
  for (const TestLevel& level : { surface, solid })
  {
    for (const int levels : { 1, 2, 4 })
    {
      for (const int columns : { 1, 3 })
      {
        if (!combinations.next())
        {
          continue;
        }
        DenseHierarchy<> h(level, levels, columns, 2);
        const Eigen::MatrixXd b = randomMatrix(level.nodes(), columns, 8);
        setState(h.finest().window().b(), b);
        CoreVCycle cycle;
        cycle.setLevels(levelsOf(h, levels), level.nodes());
        const Eigen::MatrixXd expected = denseCycle(h, levels, 0, b);
        // Twice: a cycle leaves no state that affects the next one.
        for (int run = 0; run < 2; ++run)
        {
          cycle.run();
          EXPECT_LT(
            (stateOf(h.finest().window().x(), columns) - expected).norm(), 2e-5 * expected.norm());
        }
      }
    }
  }
}

TEST(CoreVCycle, ContractsTheErrorOnManyLevels)
{
  const TestLevel level = finestLevel(toStream(shuffled(grid(40, 40, 0.2))), Weights::Clamped, 90);
  DenseHierarchy<> h(level, 5, 1, 2);
  CoreVCycle cycle;
  cycle.setLevels(levelsOf(h, 5), level.nodes());
  Eigen::MatrixXd b = randomMatrix(level.nodes(), 1, 9);
  const double before = b.norm();
  for (int k = 0; k < 5; ++k)
  {
    setState(h.finest().window().b(), b);
    cycle.run();
    b -= h.matrix(0) * stateOf(h.finest().window().x(), 1);
  }
  EXPECT_LT(b.norm(), 1e-3 * before);
}

TEST(CoreVCycle, SolvesALevelMuchSmallerThanTheFinest)
{
  constexpr int Levels = 6;
  constexpr std::int64_t Much = 1000;
  const TestLevel level = finestLevel(toStream(shuffled(grid(40, 40, 0.2))), Weights::Clamped, 400);
  for (const int columns : { 1, 3 })
  {
    DenseHierarchy<> h(level, Levels, columns, 1);
    const Eigen::MatrixXd a = h.matrix(0);
    // Smooth solutions, and one that is zero.
    Eigen::MatrixXd exact = a.ldlt().solve(Eigen::MatrixXd::Ones(level.nodes(), columns));
    if (columns > 1)
    {
      exact.col(1).setZero();
      exact.col(2) += 1e-3 * exact.col(0).norm() * randomMatrix(level.nodes(), 1, 5);
    }
    const auto error = [&](std::int64_t finest)
    {
      CoreVCycle cycle;
      cycle.setLevels(levelsOf(h, Levels), finest);
      setState(h.finest().window().b(), a * exact);
      cycle.run();
      return (stateOf(h.finest().window().x(), columns) - exact).eval();
    };
    const Eigen::MatrixXd once = error(level.nodes());
    const Eigen::MatrixXd iterated = error(Much * level.nodes());
    for (int k = 0; k < columns; ++k)
    {
      const auto energy = [&](const Eigen::VectorXd& v) { return v.dot(a * v); };
      EXPECT_LE(energy(iterated.col(k)), 0.01 * energy(exact.col(k))) << columns << ", " << k;
      EXPECT_LE(energy(iterated.col(k)), 0.1 * energy(once.col(k))) << columns << ", " << k;
    }
  }
}

TEST(CoarsestSolver, SolvesComponentsWithAndWithoutConstraint)
{
  // Two components: the second one is free.
  const TestLevel fixed = finestLevel(toStream(torus(12, 7, 0.2)), Weights::Clamped, 20);
  const TestLevel free = finestLevel(toStream(grid(9, 8, 0.2)), Weights::Clamped);
  TestLevel both = fixed;
  both.rows.insert(both.rows.end(), free.rows.begin(), free.rows.end());
  both.rowSum.insert(both.rowSum.end(), free.rowSum.begin(), free.rowSum.end());
  for (const int columns : { 1, 2 })
  {
    DenseHierarchy<> h(both, 1, columns, 1);
    CoarsestSolver solver;
    solver.factorize(h.finest().window());
    Eigen::MatrixXd b = randomMatrix(both.nodes(), columns, 2);
    auto part = b.bottomRows(free.nodes());
    part.rowwise() -= part.colwise().mean().eval();
    setState(h.finest().window().b(), b);
    solver.solve(h.finest().window());
    const Eigen::MatrixXd x = stateOf(h.finest().window().x(), columns);
    EXPECT_LT((b - h.matrix(0) * x).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(CoarsestSolver, TakesALevelWithoutNodes)
{
  DenseHierarchy<> h(TestLevel{}, 1, 1, 1);
  CoarsestSolver solver;
  solver.factorize(h.finest().window());
  solver.solve(h.finest().window());
}

} // namespace smg::testing
