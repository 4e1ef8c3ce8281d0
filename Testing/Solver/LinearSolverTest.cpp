// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/LinearSolverTesting.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/ProgressRecord.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

// Equations whose hierarchy is kept: every solution has the bits of solve() with the same
// right-hand side and initial values, whatever was solved before, and satisfies equations that were
// assembled independently.

namespace smg::testing
{
TEST(LinearSolver, HasTheBitsOfSolveWhateverWasSolvedBefore)
{
  Combinations chosen;
  for (const StreamMesh& mesh : solverMeshes())
  {
    for (const Weights weights : { Weights::Clamped, Weights::Cotangent })
    {
      for (const int columns : { 1, 3 })
      {
        for (const bool isScreened : { false, true })
        {
          if (!chosen.next())
          {
            continue;
          }
          ArrayProblem problem = posed(mesh, columns, weights, isScreened);
          MemorySource source(mesh);
          LinearSolver solver(source, problem, solverOptions());
          EXPECT_EQ(solver.columns(), columns);
          EXPECT_EQ(solver.vertices(), mesh.vertices());
          EXPECT_GT(solver.report().seconds.build, 0.0);
          expectSame(solver, mesh, problem, solverOptions(), 1e-8);
          // Other values, sources, and initial values; another tolerance; then the first ones
          // again.
          ArrayProblem other = problem;
          other.Value = randomNumbers(columns * mesh.vertices(), 5);
          other.Source = randomNumbers(columns * mesh.vertices(), 6);
          expectSame(solver, mesh, other, solverOptions(), 1e-11);
          preconditioned(solver, other.Value);
          product(solver, other.Source);
          expectSame(solver, mesh, problem, solverOptions(), 1e-8);
        }
      }
    }
  }
}

TEST(LinearSolver, TreatsFreeComponentsAsSolveDoes)
{
  const StreamMesh mesh =
    toStream(shuffled(disjointUnion(torus(60, 30, 0.3), sphere(3), { 0, 0, 5 })), TestOrder::Keep);
  for (const int columns : { 1, 3 })
  {
    for (const bool areAllFree : { true, false })
    {
      ArrayProblem problem;
      problem.Columns = columns;
      problem.EdgeWeights = Weights::Cotangent;
      problem.Prescribed.resize(static_cast<std::size_t>(mesh.vertices()));
      problem.Prescribed[7] = !areAllFree;
      problem.Source = randomNumbers(columns * mesh.vertices(), 1);
      problem.Value = randomNumbers(columns * mesh.vertices(), 2);
      MemorySource source(mesh);
      LinearSolver solver(source, problem, solverOptions());
      for (int k = 0; k < 2; ++k)
      {
        expectSame(solver, mesh, problem, solverOptions(), 1e-9);
        EXPECT_FALSE(solver.report().removed_source.empty());
      }
    }
  }
}

TEST(LinearSolver, DoesNotDependOnThreads)
{
  const StreamMesh mesh = toStream(torus(90, 45, 0.3));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  const Sides sides = sidesOf(mesh, problem);
  Numbers expected;
  for (const int threads : { 1, 2, 5 })
  {
    SolveOptions options = solverOptions();
    options.threads = threads;
    options.blockNodes = 700;
    MemorySource source(mesh, 50 * threads);
    LinearSolver solver(source, problem, options);
    Numbers x = sides.x;
    EXPECT_EQ(solver.solve(sides.b, x).threads, solver.report().threads);
    expected = expected.empty() ? x : expected;
    EXPECT_EQ(x, expected) << threads << " threads";
  }
}

TEST(LinearSolver, SolvesEquationsThatWereAssembledIndependently)
{
  for (const StreamMesh& mesh : { toStream(torus(90, 45, 0.3)), toStream(tetBox(9, 8, 7, 0.15)) })
  {
    ArrayProblem problem = posed(mesh, 1, Weights::Clamped, true);
    MemorySource source(mesh), again(mesh);
    LinearSolver solver(source, problem);
    // The unknowns of a random x, for b = A x.
    const DirectSystem direct = assembleDirect(again, problem);
    Numbers x = randomNumbers(mesh.vertices(), 9), zero(x.size());
    for (std::size_t v = 0; v < x.size(); ++v)
    {
      x[v] = problem.Prescribed[v] ? 0.0 : x[v];
    }
    const Eigen::VectorXd unknowns = direct.gather(tableOf(x, mesh.vertices()));
    const Eigen::VectorXd image = direct.matrix * unknowns;
    const Numbers b = product(solver, x);
    EXPECT_LT((direct.gather(tableOf(b, mesh.vertices())) - image).norm(), 1e-6 * image.norm());
    EXPECT_TRUE(solver.solve(b, zero, 1e-12).converged);
    EXPECT_LT(relativeError(tableOf(zero, mesh.vertices()), tableOf(x, mesh.vertices())), 1e-9);
  }
}

TEST(LinearSolver, EndsAsSolveDoesFarFromZero)
{
  const StreamMesh mesh = toStream(torus(90, 45, 0.3));
  ArrayProblem problem = heldEnds(mesh, 3, Weights::Cotangent);
  for (std::size_t i = 0; i < problem.Value.size(); ++i)
  {
    problem.Value[i] += problem.Prescribed[i / 3] ? 1e3 : 0.0;
  }
  MemorySource source(mesh);
  LinearSolver solver(source, problem, solverOptions());
  expectSame(solver, mesh, problem, solverOptions(), 1e-8);
}

TEST(LinearSolver, MultipliesAsTheReportCountsResiduals)
{
  for (const StreamMesh& mesh : solverMeshes())
  {
    // Without screening, and with regular cells, all rows count alike.
    ArrayProblem problem = posed(mesh, 2, Weights::Cotangent, false);
    MemorySource source(mesh);
    LinearSolver solver(source, problem, solverOptions());
    Sides sides = sidesOf(mesh, problem);
    // At the fixed vertices the first guess is b.
    const double first = normOf(residualOf(solver, sides.b, sides.x));
    const Report& report = solver.solve(sides.b, sides.x, 1e-5);
    const double last = normOf(residualOf(solver, sides.b, sides.x));
    ASSERT_FALSE(report.residuals.empty());
    if (!hasNote(report, "flat"))
    {
      EXPECT_NEAR(last / first / (report.residual() / report.by_pass.front().residual), 1.0, 1e-3);
    }
    // Rows of fixed vertices are those of the identity.
    const Numbers y = product(solver, sides.x);
    for (std::int64_t i = 0; i < 2 * mesh.vertices(); ++i)
    {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_TRUE(!problem.Prescribed[k / 2] || (y[k] == sides.x[k] && y[k] == sides.b[k]));
    }
  }
}

TEST(LinearSolver, SolvesAnyNumberOfColumns)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  const auto vertices = static_cast<std::size_t>(mesh.vertices());
  ArrayProblem problem = posed(mesh, 2, Weights::Cotangent, false);
  MemorySource source(mesh);
  LinearSolver solver(source, problem, solverOptions());
  const Numbers b = randomNumbers(5 * mesh.vertices(), 11);
  const Numbers start = randomNumbers(5 * mesh.vertices(), 12);
  Numbers all = start;
  const Report report = solver.solve(b, all);
  ASSERT_EQ(report.steps.size(), 3u);
  EXPECT_EQ(report.steps[0].name, "columns 1 to 2");
  EXPECT_EQ(report.steps[2].name, "column 5");
  int cycles = 0;
  for (std::size_t first = 0; first < 5; first += 2)
  {
    const std::size_t count = std::min<std::size_t>(2, 5 - first);
    Numbers part(count * vertices), of(count * vertices);
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      part[i] = start[5 * (i / count) + first + i % count];
      of[i] = b[5 * (i / count) + first + i % count];
    }
    cycles += solver.solve(of, part).cycles;
    EXPECT_TRUE(solver.report().steps.empty());
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      ASSERT_EQ(part[i], all[5 * (i / count) + first + i % count]);
    }
  }
  EXPECT_EQ(report.cycles, cycles);
  EXPECT_EQ(report.residuals.size(), static_cast<std::size_t>(cycles));
  EXPECT_TRUE(report.converged);
  // Likewise the other operations.
  const Numbers image = product(solver, b), smooth = preconditioned(solver, b);
  Numbers third(vertices);
  for (std::size_t v = 0; v < vertices; ++v)
  {
    third[v] = b[5 * v + 2];
  }
  const Numbers one = product(solver, third), M = preconditioned(solver, third);
  for (std::size_t v = 0; v < vertices; ++v)
  {
    EXPECT_EQ(image[5 * v + 2], one[v]);
    EXPECT_NEAR(smooth[5 * v + 2], M[v], 1e-5);
  }
}

TEST(LinearSolver, GivesUndeterminedVerticesTheRightHandSide)
{
  // Vertex 4 belongs to a cell without area alone.
  const StreamMesh mesh =
    toStream({ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 2, 0, 3, 3, 0 },
               { 0, 1, 2, 1, 3, 2, 3, 4, 5 } },
      TestOrder::Keep);
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  problem.Prescribed = { 1, 0, 0, 0, 0, 0 };
  problem.KeepsUndetermined = false;
  MemorySource source(mesh);
  LinearSolver solver(source, problem);
  const Numbers b{ 2, 0, 0, 0, 7, 8 };
  Numbers x(6);
  EXPECT_TRUE(hasNote(solver.solve(b, x, 1e-12), "those of the right-hand side"));
  for (std::size_t v = 0; v < 6; ++v)
  {
    EXPECT_NEAR(x[v], v < 4 ? 2.0 : b[v], 1e-9);
  }
  EXPECT_EQ(preconditioned(solver, b)[5], 8);
  EXPECT_EQ(product(solver, b)[5], 8);
}

TEST(LinearSolver, TakesDescriptionsOfStoredMeshes)
{
  const MemoryMesh mesh(toStream(torus(60, 30, 0.3)));
  ProblemDescription description;
  description.screening = 2.0;
  LinearSolver solver(mesh, description);
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  problem.Screening = 2.0;
  MemorySource source(mesh.mesh());
  LinearSolver other(source, problem);
  const Numbers b = randomNumbers(mesh.mesh().vertices(), 1);
  EXPECT_LT(normOf(residualOf(other, product(solver, b), b)), 1e-6 * normOf(product(solver, b)));
  // Nothing at all: a free component.
  LinearSolver free(mesh, {});
  Numbers x(b.size());
  EXPECT_TRUE(free.solve(b, x).converged);
  EXPECT_EQ(free.report().free_components, 1);
}

TEST(LinearSolver, IsRightAgainAfterASolveThatWasCancelledAnywhere)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  const Sides sides = sidesOf(mesh, problem);
  SolveOptions options = solverOptions();
  options.blockNodes = 100;
  MemorySource source(mesh);
  LinearSolver solver(source, problem, options);
  Numbers expected = sides.x;
  ProgressRecord record;
  solver.solve(sides.b, expected, 1e-8, 50, record.function());
  record.expectRise(0.35);
  int calls = 0, cancelAt = std::numeric_limits<int>::max();
  const ProgressFunction count = [&](double) { return calls++ != cancelAt; };
  Numbers x = sides.x;
  solver.solve(sides.b, x, 1e-8, 50, count);
  const int all = calls;
  ASSERT_GT(all, 10);
  for (int k = 0; k < all - 1; k += 5)
  {
    calls = 0;
    cancelAt = k;
    x = sides.x;
    EXPECT_THROW(solver.solve(sides.b, x, 1e-8, 50, count), Cancelled);
    EXPECT_EQ(x, sides.x);
    solver.solve(sides.b, x);
    EXPECT_EQ(x, expected) << "cancelled at call " << k;
  }
}

TEST(LinearSolver, ReportsTheProgressOfBuilding)
{
  const StreamMesh mesh = toStream(torus(200, 100));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  ProgressRecord record;
  SolveOptions options = solverOptions();
  options.progress = record.function();
  MemorySource source(mesh, 100);
  const LinearSolver solver(source, problem, options);
  record.expectRise(0.1);
}

TEST(LinearSolver, RefusesWhatIsNotValid)
{
  const StreamMesh mesh = toStream(torus(60, 30));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  MemorySource source(mesh);
  LinearSolver solver(source, problem);
  const auto n = static_cast<std::size_t>(mesh.vertices());
  Numbers b(n), x(n), longer(n + 1), none;
  expectError([&] { solver.solve(longer, longer); }, "numbers");
  expectError([&] { solver.solve(b, longer); }, "numbers");
  expectError([&] { solver.solve(none, none); }, "numbers");
  expectError([&] { solver.multiply(b, longer); }, "numbers");
  expectError([&] { solver.solve(b, x, 0.0); }, "tolerance");
  expectError([&] { solver.solve(b, x, 2.0); }, "tolerance");
  expectError([&] { solver.solve(b, x, 1e-8, 0); }, "V-cycle");
  b[5] = std::numeric_limits<double>::quiet_NaN();
  expectError(
    [&] { solver.solve(b, x); }, "right-hand side has a number that is not finite at vertex 5");
  expectError([&] { solver.precondition(b, x); }, "not finite");
  std::ranges::fill(b, 1e300);
  expectError([&] { solver.solve(b, x); }, "overflow");
  // And goes on.
  std::ranges::fill(b, 1.0);
  EXPECT_TRUE(solver.solve(b, x).converged);
}

TEST(LinearSolver, RefusesTiedVertices)
{
  class Tied : public ArrayProblem
  {
  public:
    std::shared_ptr<const VertexCouplings> couplings() const override
    {
      auto couplings = std::make_shared<VertexCouplings>();
      couplings->ties.push_back({ 7, 3 });
      return couplings;
    }
  };
  Tied problem;
  problem.EdgeWeights = Weights::Cotangent;
  const StreamMesh mesh = toStream(torus(60, 30));
  MemorySource source(mesh);
  expectError([&] { LinearSolver(source, problem); }, "vertices that are one");
  expectError([&] { SystemOnDisk(source, problem); }, "vertices that are one");
}

TEST(LinearSolver, NamesTheMemoryThatItNeeds)
{
  const StreamMesh mesh = toStream(torus(200, 100));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  SolveOptions options;
  options.memoryLimit = MiB;
  MemorySource source(mesh);
  expectError([&] { LinearSolver(source, problem, options); }, "but the limit is 1 MiB");
}

} // namespace smg::testing
