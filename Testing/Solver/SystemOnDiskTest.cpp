// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/LinearSolverTesting.h"
#include "Testing/Support/MemoryMesh.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

// Equations whose hierarchy stays on scratch files: every solution has the bits of solve(),
// whatever was solved before.

namespace smg::testing
{
namespace
{

SolveOptions onDisk(double tolerance = 1e-8)
{
  SolveOptions options = solverOptions(tolerance);
  options.inCore = false;
  return options;
}

ArrayProblem other(const ArrayProblem& problem, const StreamMesh& mesh)
{
  ArrayProblem other = problem;
  other.Value = randomNumbers(problem.Columns * mesh.vertices(), 5);
  other.Source = randomNumbers(problem.Columns * mesh.vertices(), 6);
  return other;
}

} // namespace

TEST(SystemOnDisk, HasTheBitsOfSolveWhateverWasSolvedBefore)
{
  for (const StreamMesh& mesh : solverMeshes())
  {
    for (const int columns : { 1, 3 })
    {
      const Weights weights = columns == 1 ? Weights::Cotangent : Weights::Clamped;
      const ArrayProblem problem = posed(mesh, columns, weights, columns == 3);
      ArrayProblem built = problem;
      MemorySource source(mesh);
      SystemOnDisk system(source, built, onDisk());
      EXPECT_EQ(system.columns(), columns);
      EXPECT_EQ(system.vertices(), mesh.vertices());
      expectSame(system, mesh, problem, onDisk(), 1e-8);
      expectSame(system, mesh, other(problem, mesh), onDisk(), 1e-11);
      SystemOnDisk moved = std::move(system);
      expectSame(moved, mesh, problem, onDisk(), 1e-8);
    }
  }
}

TEST(SystemOnDisk, TreatsFreeComponentsAsSolveDoes)
{
  const StreamMesh mesh =
    toStream(shuffled(disjointUnion(torus(60, 30, 0.3), sphere(3), { 0, 0, 5 })), TestOrder::Keep);
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  problem.Prescribed.resize(static_cast<std::size_t>(mesh.vertices()));
  problem.Prescribed[7] = 1;
  problem.Source = randomNumbers(mesh.vertices(), 1);
  problem.Value = randomNumbers(mesh.vertices(), 2);
  ArrayProblem built = problem;
  MemorySource source(mesh);
  SystemOnDisk system(source, built, onDisk());
  for (int k = 0; k < 2; ++k)
  {
    expectSame(system, mesh, problem, onDisk(), 1e-9);
    EXPECT_FALSE(system.report().removed_source.empty());
  }
}

TEST(SystemOnDisk, DoesNotDependOnThreadsOrBlocks)
{
  const StreamMesh mesh = toStream(torus(90, 45, 0.3));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  const Sides sides = sidesOf(mesh, problem);
  Numbers expected;
  for (const int threads : { 1, 2, 5 })
  {
    SolveOptions options = onDisk();
    options.threads = threads;
    options.blockNodes = 700;
    MemorySource source(mesh, 50 * threads);
    SystemOnDisk system(source, problem, options);
    for (int k = 0; k < 2; ++k)
    {
      Numbers x = sides.x;
      system.solve(sides.b, x);
      expected = expected.empty() ? x : expected;
      EXPECT_EQ(x, expected) << threads << " threads";
    }
  }
}

TEST(SystemOnDisk, HasKnownNeighboursThatLieFarAwayInTheStream)
{
  // Rows of vertices that are longer than a block, the first of them known in half of their
  // vertices: blocks without unknowns, to which rows of later blocks have edges.
  const StreamMesh mesh = toStream(grid(5000, 12), TestOrder::Keep);
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Cotangent;
  problem.Prescribed.resize(static_cast<std::size_t>(mesh.vertices()));
  std::fill_n(problem.Prescribed.begin(), 2500, std::uint8_t(1));
  problem.Value = randomNumbers(mesh.vertices(), 2);
  problem.Source = randomNumbers(mesh.vertices(), 3);
  for (const int threads : { 1, 3 })
  {
    SolveOptions options = onDisk();
    options.blockNodes = 100;
    options.threads = threads;
    ArrayProblem built = problem;
    MemorySource source(mesh);
    SystemOnDisk system(source, built, options);
    expectSame(system, mesh, problem, options, 1e-8);
  }
}

TEST(SystemOnDisk, ReportsTheTrafficOfEachSolveAlone)
{
  const StreamMesh mesh = toStream(torus(90, 45, 0.3));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  const Sides sides = sidesOf(mesh, problem);
  MemorySource source(mesh);
  SystemOnDisk system(source, problem, onDisk());
  Report first;
  for (int k = 0; k < 3; ++k)
  {
    Numbers x = sides.x;
    const Report& report = system.solve(sides.b, x);
    first = k == 0 ? report : first;
    EXPECT_EQ(report.bytes_by_kind.size(), first.bytes_by_kind.size());
    EXPECT_EQ(report.bytes_read, first.bytes_read);
    EXPECT_EQ(report.bytes_written, first.bytes_written);
    ASSERT_EQ(report.by_pass.size(), first.by_pass.size());
    for (std::size_t pass = 0; pass < first.by_pass.size(); ++pass)
    {
      EXPECT_EQ(report.by_pass[pass].read, first.by_pass[pass].read);
      EXPECT_EQ(report.by_pass[pass].written, first.by_pass[pass].written);
    }
  }
}

TEST(SystemOnDisk, TakesVectorsABlockAtATime)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = posed(mesh, 2, Weights::Cotangent, false);
  MemorySource source(mesh);
  SystemOnDisk system(source, problem, onDisk());
  const Numbers b = randomNumbers(5 * mesh.vertices(), 11);
  const Numbers start = randomNumbers(5 * mesh.vertices(), 12);
  Numbers expected = start, x(b.size());
  EXPECT_EQ(system.solve(b, expected).steps.size(), 3U);
  std::int64_t given = 0, taken = 0;
  const auto place = [](const VectorBlock& block, std::int64_t i, std::int64_t k)
  { return static_cast<std::size_t>(5 * (block.first + i) + block.column + k); };
  const auto forNumbers = [&](const VectorBlock& block, auto&& f)
  {
    for (std::int64_t i = 0; i < block.count; ++i)
    {
      for (std::int64_t k = 0; k < block.columns; ++k)
      {
        f(static_cast<std::size_t>(i * block.columns + k), place(block, i, k));
      }
    }
  };
  const Report& report = system.solve(
    5,
    [&](const VectorBlock& block, std::span<double> right, std::span<double> initial)
    {
      given += block.count * block.columns;
      forNumbers(block,
        [&](std::size_t to, std::size_t from)
        {
          EXPECT_EQ(right[to], 0.0);
          right[to] = b[from];
          initial[to] = start[from];
        });
    },
    [&](const VectorBlock& block, std::span<const double> solution)
    {
      taken += block.count * block.columns;
      forNumbers(block, [&](std::size_t from, std::size_t to) { x[to] = solution[from]; });
    });
  EXPECT_EQ(x, expected);
  EXPECT_EQ(given, 5 * mesh.vertices());
  EXPECT_EQ(taken, 5 * mesh.vertices());
  // Each group of columns takes a pass more than V-cycles.
  EXPECT_EQ(report.passes, report.cycles + 3);
}

TEST(SystemOnDisk, IsRightAgainAfterASolveThatWasBrokenOffAnywhere)
{
  const StreamMesh mesh = toStream(torus(60, 30, 0.3));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  const Sides sides = sidesOf(mesh, problem);
  for (const int threads : { 1, 3 })
  {
    SolveOptions options = onDisk();
    options.blockNodes = 100;
    options.coreNodes = 100;
    options.threads = threads;
    MemorySource source(mesh);
    SystemOnDisk system(source, problem, options);
    int calls = 0, cancelAt = std::numeric_limits<int>::max();
    const ProgressFunction count = [&](double) { return calls++ != cancelAt; };
    Numbers expected = sides.x;
    const std::int64_t nodes = system.solve(sides.b, expected, 1e-8, 50, count).peak_nodes;
    const int all = calls;
    ASSERT_GT(all, 10);
    for (int k = 0; k < all - 1; k += 5)
    {
      calls = 0;
      cancelAt = k;
      Numbers x = sides.x;
      EXPECT_THROW(system.solve(sides.b, x, 1e-8, 50, count), Cancelled);
      EXPECT_EQ(x, sides.x);
      EXPECT_EQ(system.solve(sides.b, x).peak_nodes, nodes);
      EXPECT_EQ(x, expected) << "cancelled at call " << k;
    }
    // What is not a number is found in the middle of a pass.
    for (const std::size_t v : { std::size_t(0), sides.b.size() / 2, sides.b.size() - 1 })
    {
      Numbers b = sides.b, x = sides.x;
      b[v] = std::numeric_limits<double>::quiet_NaN();
      try
      {
        system.solve(b, x);
        ADD_FAILURE();
      }
      catch (const Error& error)
      {
        EXPECT_NE(
          std::string(error.what()).find("at vertex " + std::to_string(v) + " "), std::string::npos)
          << error.what();
      }
      EXPECT_EQ(x, sides.x);
      system.solve(sides.b, x);
      EXPECT_EQ(x, expected);
    }
  }
}

TEST(SystemOnDisk, SolvesWithinTheMemoryOfASolve)
{
  const StreamMesh mesh = toStream(grid(400, 300));
  ArrayProblem problem = posed(mesh, 1, Weights::Cotangent, false);
  const Solved solved = solveMesh(mesh, problem, onDisk());
  MemorySource source(mesh);
  SystemOnDisk system(source, problem, onDisk());
  Numbers x(static_cast<std::size_t>(mesh.vertices()));
  const Numbers b = randomNumbers(mesh.vertices(), 4);
  const Report& report = system.solve(b, x);
  EXPECT_LT(report.pool_bytes_peak, solved.report.pool_bytes_peak * 11 / 10);
  EXPECT_LT(report.peak_nodes, solved.report.peak_nodes * 11 / 10);
}

TEST(SystemOnDisk, RefusesWhatIsNotValid)
{
  const MemoryMesh mesh(toStream(grid(12, 9)));
  SolveOptions options;
  options.checkpoint.folder = "kept";
  EXPECT_THROW(SystemOnDisk(mesh, {}, options), Error);
  SystemOnDisk system(mesh, {});
  Numbers b(static_cast<std::size_t>(system.vertices())), x(b.size() - 1);
  EXPECT_THROW(system.solve(b, x), Error);
  x = b;
  EXPECT_THROW(system.solve(b, x, 2.0), Error);
  EXPECT_THROW(system.solve(0, {}, {}), Error);
  EXPECT_TRUE(system.solve(b, x).converged);
}

} // namespace smg::testing
