// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/LinearSolverTesting.h"

#include <gtest/gtest.h>

// The V-cycle of a linear solver as a preconditioner: a symmetric positive definite matrix, with
// which conjugate gradients need few steps.

namespace smg::testing
{
namespace
{

/** The steps of preconditioned conjugate gradients until the residual is `tolerance` of b. */
int steps(LinearSolver& solver, const Numbers& b, Numbers& x, double tolerance)
{
  Numbers r = residualOf(solver, b, x), z = preconditioned(solver, r), p = z;
  double rz = dot(r, z);
  int k = 0;
  for (; k < 200 && normOf(r) > tolerance * normOf(b); ++k)
  {
    const Numbers image = product(solver, p);
    const double length = rz / dot(p, image);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x[i] += length * p[i];
      r[i] -= length * image[i];
    }
    z = preconditioned(solver, r);
    const double next = dot(r, z);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      p[i] = z[i] + next / rz * p[i];
    }
    rz = next;
  }
  return k;
}

struct Equations
{
  StreamMesh mesh;
  ArrayProblem problem;
  bool isRegular; // its cells

  LinearSolver solver(std::int64_t coreNodes = 500, int sweeps = 2)
  {
    SolveOptions options;
    options.coreNodes = coreNodes;
    options.sweeps = sweeps;
    MemorySource source(this->mesh);
    return { source, this->problem, options };
  }
};

std::vector<Equations> allEquations()
{
  std::vector<Equations> all;
  const auto add = [&](const IndexedTestMesh& mesh, bool isRegular)
  {
    const StreamMesh stream = toStream(mesh);
    all.push_back({ stream, heldEnds(stream, 1, Weights::Cotangent), isRegular });
  };
  add(torus(120, 60, 0.3), true);
  add(tetBox(16, 15, 14, 0.15), true);
  add(gridWithNeedle(40, 30, 1e-4), false); // patches, and weights in double precision
  add(sliverChains(60, 40, 1e-3), false);
  return all;
}

} // namespace

TEST(LinearSolverPrecondition, IsSymmetricAndPositive)
{
  for (Equations& of : allEquations())
  {
    for (const int sweeps : { 1, 2, 3 })
    {
      LinearSolver solver = of.solver(500, sweeps);
      for (std::uint64_t seed = 0; seed < 3; ++seed)
      {
        const Numbers r = randomNumbers(of.mesh.vertices(), 2 * seed);
        const Numbers s = randomNumbers(of.mesh.vertices(), 2 * seed + 1);
        const Numbers Mr = preconditioned(solver, r), Ms = preconditioned(solver, s);
        const double own = dot(r, Mr), other = dot(s, Ms);
        EXPECT_GT(own, 0.0);
        EXPECT_GT(other, 0.0);
        EXPECT_LT(std::fabs(dot(r, Ms) - dot(s, Mr)), 2e-6 * std::sqrt(own * other));
      }
    }
  }
}

TEST(LinearSolverPrecondition, IsTheIdentityAtFixedVertices)
{
  for (Equations& of : allEquations())
  {
    LinearSolver solver = of.solver();
    Numbers r = randomNumbers(of.mesh.vertices(), 1);
    const Numbers z = preconditioned(solver, r);
    for (std::size_t v = 0; v < r.size(); ++v)
    {
      if (of.problem.Prescribed[v])
      {
        EXPECT_EQ(z[v], r[v]);
        r[v] = 1000.0; // has no effect on others
      }
    }
    const Numbers other = preconditioned(solver, r);
    double scale = 0.0;
    for (std::size_t v = 0; v < r.size(); ++v)
    {
      scale = std::max(scale, of.problem.Prescribed[v] ? 0.0 : std::fabs(z[v]));
    }
    for (std::size_t v = 0; v < r.size(); ++v)
    {
      EXPECT_TRUE(of.problem.Prescribed[v] || std::fabs(other[v] - z[v]) <= 1e-5 * scale);
    }
  }
}

TEST(LinearSolverPrecondition, IsLinearInAnyUnit)
{
  for (Equations& of : allEquations())
  {
    LinearSolver solver = of.solver();
    const Numbers r = randomNumbers(of.mesh.vertices(), 1);
    const Numbers z = preconditioned(solver, r);
    for (const int exponent : { -600, -60, 60, 600 })
    {
      Numbers scaled = r;
      std::ranges::for_each(scaled, [&](double& value) { value = std::ldexp(value, exponent); });
      const Numbers image = preconditioned(solver, scaled);
      for (std::size_t v = 0; v < r.size(); ++v)
      {
        ASSERT_EQ(image[v], std::ldexp(z[v], exponent));
      }
    }
  }
}

TEST(LinearSolverPrecondition, ConjugateGradientsNeedFewSteps)
{
  for (Equations& of : allEquations())
  {
    LinearSolver solver = of.solver();
    const Numbers b = randomNumbers(of.mesh.vertices(), 1);
    Numbers x(b.size()), expected(b.size());
    for (std::size_t v = 0; v < b.size(); ++v)
    {
      x[v] = of.problem.Prescribed[v] ? b[v] : 0.0;
    }
    EXPECT_LE(steps(solver, b, x, 1e-10), of.isRegular ? 15 : 40);
    solver.solve(b, expected, 1e-11);
    EXPECT_LT(
      relativeError(tableOf(x, of.mesh.vertices()), tableOf(expected, of.mesh.vertices())), 1e-7);
  }
}

TEST(LinearSolverPrecondition, ServesFreeComponents)
{
  const StreamMesh mesh = toStream(disjointUnion(torus(60, 30, 0.3), sphere(3), { 0, 0, 5 }));
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  Equations of{ mesh, problem, true };
  LinearSolver solver = of.solver(0);
  const Numbers r = randomNumbers(mesh.vertices(), 1), s = randomNumbers(mesh.vertices(), 2);
  const Numbers Mr = preconditioned(solver, r), Ms = preconditioned(solver, s);
  EXPECT_GT(dot(r, Mr), 0.0);
  EXPECT_LT(std::fabs(dot(r, Ms) - dot(s, Mr)), 2e-6 * std::sqrt(dot(r, Mr) * dot(s, Ms)));
  // A right-hand side that has a solution.
  const Numbers b = product(solver, randomNumbers(mesh.vertices(), 3));
  Numbers x(b.size());
  EXPECT_LE(steps(solver, b, x, 1e-9), 15);
  EXPECT_LT(normOf(residualOf(solver, b, x)), 1e-8 * normOf(b));
}

} // namespace smg::testing
