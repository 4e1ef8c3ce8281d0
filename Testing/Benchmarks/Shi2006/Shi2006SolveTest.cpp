// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Shi2006/Shi2006.h"
#include "Testing/Benchmarks/Shi2006/Shi2006Testing.h"

#include <gtest/gtest.h>

#include <numeric>

// A solve with the equations of the paper: its report and its errors.

namespace smg::testing
{
namespace
{

SolveOptions literal(double tolerance = 1e-6)
{
  SolveOptions options;
  options.inCore = true;
  options.tolerance = tolerance;
  return options;
}

ArrayProblem deformed(const StreamMesh& mesh, int columns = 3)
{
  ArrayProblem problem = heldEndsOf(mesh, wavy, columns, Weights::Uniform);
  problem.Target = scaledEdges(columns);
  return problem;
}

} // namespace

TEST(Shi2006Solve, SaysThatItDoesNotConverge)
{
  const StreamMesh mesh = toStream(torus(90, 45, 0.3));
  ArrayProblem problem = deformed(mesh);
  const Solved solved = solveByPaper(mesh, problem, literal());
  const Report& report = solved.report;
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(hasNote(report, "not converged"));
  EXPECT_TRUE(hasNote(report, "bias"));
  EXPECT_TRUE(hasNote(report, "extended"));
  EXPECT_EQ(report.cycles, 2);
  ASSERT_EQ(report.residuals.size(), 2U);
  EXPECT_NEAR(report.residuals[0], report.residuals[1], 1e-9 * report.residuals[0]);
  EXPECT_GT(report.residuals[0], 1e-5);
  EXPECT_LT(report.residuals[0], 0.1);
  MemorySource source(mesh);
  const DirectSystem system = assembleDirect(source, problem);
  const auto residual = [&system](const Eigen::MatrixXd& unknowns)
  { return (system.rightSide - system.matrix * unknowns).norm(); };
  EXPECT_NEAR(residual(system.gather(solved.values)) / residual(system.initial()),
    report.residual(), 1e-9 * report.residual());
  // The default operator set has no such bias.
  EXPECT_TRUE(solveMesh(mesh, problem, literal()).report.converged);
}

TEST(Shi2006Solve, ConvergesWhereTheTargetsAreDifferences)
{
  for (const StreamMesh& mesh :
    { toStream(torus(90, 45, 0.3)), toStream(tetBox(13, 14, 12, 0.15)) })
  {
    ArrayProblem problem = heldEndsOf(mesh, wavy, 2, Weights::Clamped);
    problem.Target = differencesOf(wavy, 2);
    const Solved solved = solveByPaper(mesh, problem, literal(1e-15));
    EXPECT_TRUE(solved.report.converged);
    EXPECT_EQ(solved.report.cycles, 1);
    EXPECT_FALSE(hasNote(solved.report, "not converged"));
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      ASSERT_NEAR(solved.values(v, 1), wavy(&mesh.positions[3 * v], 1), 1e-11);
    }
  }
}

TEST(Shi2006Solve, ScreeningTowardsAConstantIsSolvedAtOnce)
{
  // (L + s M) c = M s c: the solution has no differences, and there are no targets.
  const StreamMesh mesh = toStream(torus(90, 45, 0.3));
  ArrayProblem problem;
  problem.Screening = 3.0;
  problem.Source.assign(mesh.vertices(), 3.0 * 7.0);
  const Solved solved = solveByPaper(mesh, problem, literal(1e-12));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_EQ(solved.report.cycles, 1);
  EXPECT_LT((solved.values.array() - 7.0).abs().maxCoeff(), 1e-11);
}

TEST(Shi2006Solve, InitialValuesThatAreTheSolutionAreLeftAlone)
{
  const StreamMesh mesh = toStream(torus(30, 20, 0.3));
  ArrayProblem problem = deformed(mesh, 1);
  const Eigen::MatrixXd solution = solveDirectly(mesh, problem);
  problem.Value.assign(solution.data(), solution.data() + solution.size());
  const Solved solved = solveByPaper(mesh, problem, literal());
  EXPECT_TRUE(solved.report.converged);
  EXPECT_EQ(solved.report.cycles, 0);
  EXPECT_TRUE(sameBits(solved.values, solution));
  // Nearly the solution: the V-cycle increases the residual, as the report states.
  problem.Value[7] += problem.Prescribed[7] ? 0.0 : 1e-9;
  problem.Value[300] += problem.Prescribed[300] ? 0.0 : 1e-9;
  const Report report = solveByPaper(mesh, problem, literal()).report;
  EXPECT_FALSE(report.converged);
  EXPECT_GT(report.residual(), 100.0);
}

TEST(Shi2006Solve, BlocksThreadsAndPiecesDoNotMatter)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = deformed(mesh);
  SolveOptions options = literal();
  const Solved whole = solveByPaper(mesh, problem, options);
  options.threads = 2;
  options.blockNodes = 7;
  options.coreNodes = 0;
  EXPECT_TRUE(sameBits(solveByPaper(mesh, problem, options, 1).values, whole.values));
  EXPECT_TRUE(sameBits(solveByPaper(mesh, problem, options, 37).values, whole.values));
}

TEST(Shi2006Solve, ComponentsWithoutConstraintKeepTheirMean)
{
  const StreamMesh mesh =
    toStream(disjointUnion(torus(60, 30, 0.3), torus(40, 20, 0.3, 5), { 10, 0, 0 }));
  ArrayProblem problem = heldEndsOf(mesh, wavy, 1, Weights::Uniform);
  problem.Target = differencesOf(wavy, 1);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    const bool free = p[0] > 5.0;
    problem.Prescribed[v] = problem.Prescribed[v] && !free;
    problem.Value[v] = free ? 3.0 : problem.Prescribed[v] ? wavy(p, 0) : 0.0;
  }
  for (const bool incompatible : { false, true })
  {
    problem.Source.assign(incompatible ? mesh.vertices() : 0, 0.0);
    for (std::int64_t v = 0; incompatible && v < mesh.vertices(); ++v)
    {
      problem.Source[v] = mesh.positions[3 * v] > 5.0 ? 1e-3 : 0.0;
    }
    const Solved solved = solveByPaper(mesh, problem, literal(1e-10));
    EXPECT_EQ(solved.report.free_components, 1);
    EXPECT_TRUE(hasNote(solved.report, "keep the mean"));
    EXPECT_EQ(hasNote(solved.report, "do not sum to zero"), incompatible);
    MemorySource source(mesh);
    const Eigen::VectorXd mass = assembleDirect(source, problem).mass;
    double sum = 0.0;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      sum += mesh.positions[3 * v] > 5.0 ? mass[v] * (solved.values(v) - 3.0) : 0.0;
    }
    EXPECT_NEAR(sum, 0.0, 1e-9);
    if (!incompatible)
    {
      EXPECT_TRUE(solved.report.converged);
      EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-11);
    }
  }
}

TEST(Shi2006Solve, VerticesThatArePrescribedOrHeldKeepTheirValue)
{
  StreamMesh mesh = toStream(grid(20, 20));
  const std::int64_t before = mesh.vertices();
  mesh.positions.insert(mesh.positions.end(), { 50, 0, 0, 51, 0, 0, 52, 0, 0 });
  mesh.corners.insert(mesh.corners.end(), { before, before + 1, before + 2 }); // no area
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  std::fill(problem.Prescribed.begin() + before, problem.Prescribed.end(), 0);
  problem.Value[before] = 7;
  for (const bool all : { false, true })
  {
    if (all)
    {
      std::fill(problem.Prescribed.begin(), problem.Prescribed.end(), 1);
    }
    const Solved solved = solveByPaper(mesh, problem, literal());
    const Report& report = solved.report;
    EXPECT_EQ(report.held, all ? 0 : 3);
    EXPECT_EQ(report.levels[0].nodes, mesh.vertices() - report.held - report.prescribed);
    EXPECT_EQ(report.cycles == 0, all);
    EXPECT_EQ(solved.values(before), 7);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      ASSERT_TRUE(!problem.Prescribed[v] || solved.values(v) == problem.Value[v]);
    }
  }
}

TEST(Shi2006Solve, ATornHierarchyIsTold)
{
  const IndexedTestMesh ring = torus(90, 45, 0.3);
  for (const bool scattered : { false, true })
  {
    const StreamMesh mesh = scattered ? toStream(shuffled(ring), TestOrder::Keep) : toStream(ring);
    ArrayProblem problem = deformed(mesh);
    EXPECT_EQ(hasNote(solveByPaper(mesh, problem, literal()).report, "torn"), scattered);
  }
}

TEST(Shi2006Solve, RangesOfVerticesAreThoseOfTheWhole)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = deformed(mesh);
  MemorySource source(mesh);
  Shi2006 solution(problem.columns(), literal());
  solution.solve(source, problem);
  const Eigen::MatrixXd all = valuesOf(solution);
  std::vector<double> part(3 * 100);
  solution.read(517, 100, part);
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(part[3 * i + 2], all(517 + i, 2));
  }
  expectError([&] { solution.read(mesh.vertices() - 99, 100, part); }, "1800");
  expectError([&] { solution.read(0, 101, part); }, "room");
}

TEST(Shi2006Solve, IsNoOperatorSetOfTheLibrary)
{
  const StreamMesh mesh = toStream(torus(10, 10));
  ArrayProblem problem = deformed(mesh);
  SolveOptions options = literal();
  options.operators = "shi2006";
  expectError([&] { solveMesh(mesh, problem, options); }, "solve_shi2006");
  options.operators = "none";
  expectError([&] { solveMesh(mesh, problem, options); }, "use extended");
  options.tolerance = SolveOptions::AutomaticTolerance;
  expectError([&] { solveByPaper(mesh, problem, options); }, "no automatic tolerance");
}

TEST(Shi2006Solve, ItsMemoryIsEstimated)
{
  const StreamMesh mesh = toStream(torus(200, 100, 0.3));
  ArrayProblem problem = deformed(mesh);
  const std::int64_t need = solveByPaper(mesh, problem, literal()).report.pool_bytes_peak;
  const std::int64_t estimate = Shi2006::estimateMemory(MemorySource(mesh).info(), 3);
  EXPECT_LT(estimate, need);
  EXPECT_GT(estimate, 0.6 * static_cast<double>(need));
}

TEST(Shi2006Solve, CanBeCancelledAtAnyTime)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = deformed(mesh);
  SolveOptions options = literal();
  std::vector<double> seen;
  options.progress = [&](double done)
  {
    seen.push_back(done);
    return true;
  };
  solveByPaper(mesh, problem, options);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
  for (const double at : { 0.1, 0.41, 0.9 })
  {
    options.progress = [at](double done) { return done < at; };
    EXPECT_THROW(solveByPaper(mesh, problem, options), Cancelled);
  }
}

} // namespace smg::testing
