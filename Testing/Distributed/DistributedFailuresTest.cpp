// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartMemory.h"
#include "Solver/Distributed/Team.h"
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Support/ArrayHandles.h"

#include <HYPRE_IJ_mv.h>
#include <HYPRE_utilities.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <span>

// A failure of one process ends the work of all, with one message. A process that waited for ever
// would be ended by the watchdog of the program, and the test with it.

namespace smg::testing
{
namespace
{

/** Holds one end; process `failing` does something else while it is asked. */
class FailingProblem : public ElementProblem
{
public:
  FailingProblem(const StreamMesh& mesh, int failing, std::function<void(CellBatch&)> failure)
    : ElementProblem(mesh)
    , Fails(rankOfTest() == failing)
    , Failure(std::move(failure))
  {
    this->DirichletConditions.push_back(
      { below(0, 0.6), columnsOf(1, [](const Point& p, int) { return p[1]; }) });
    this->VertexSource = columnsOf(1, [](const Point& p, int) { return p[0]; });
  }

  bool hasCells() const override { return true; }
  void cells(CellBatch& batch) override
  {
    if (this->Fails)
    {
      this->Failure(batch);
    }
  }

private:
  bool Fails;
  std::function<void(CellBatch&)> Failure;
};

StreamMesh meshOfTest()
{
  return patch(14, 12);
}

/** The message of a solve in which `failing` fails; expects that the next solve succeeds. */
std::string messageOfSolve(int failing, const std::function<void(CellBatch&)>& failure)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, failing, failure);
  const std::string message = messageOf([&] { solver.solve(problem); });
  FailingProblem good(own, -1, failure);
  DistributedOptions options;
  options.tolerance = 0.1;
  EXPECT_TRUE(solver.solve(good, options).report.converged);
  return message;
}

} // namespace

TEST(DistributedFailures, OfAProcessIsThatOfAll)
{
  for (const int failing : { 0, sizeOfTest() - 1 })
  {
    EXPECT_EQ(messageOfSolve(failing, [](CellBatch&) { throw Error("the disk is full"); }),
      "the disk is full");
  }
}

TEST(DistributedFailures, ThatAllKnowAreOfATypeOfTheirOwn)
{
  Team team(MPI_COMM_WORLD);
  const auto failIn = [](int process, const auto& error)
  {
    if (rankOfTest() == process)
    {
      throw error;
    }
  };
  const int last = sizeOfTest() - 1;
  EXPECT_THROW(team.run([&] { failIn(last, Error("no room")); }), TeamError);
  EXPECT_THROW(team.run([&] { failIn(last, std::bad_alloc()); }), TeamError);
  EXPECT_THROW(team.run([&] { failIn(last, Cancelled()); }), Cancelled);
  // Within another, as solvers are run by programs.
  EXPECT_THROW(team.run([&] { team.run([&] { failIn(last, Error("no room")); }); }), TeamError);
}

TEST(DistributedFailures, AfterACommonOneConcernNoOtherProcess)
{
  Team team(MPI_COMM_WORLD);
  const auto failTwice = [&]
  {
    try
    {
      team.run([] { throw Error("no room"); });
    }
    catch (const TeamError&)
    {
      if (rankOfTest() == 0)
      {
        throw std::bad_alloc(); // for the message, say
      }
      throw;
    }
  };
  if (rankOfTest() == 0)
  {
    EXPECT_THROW(team.run(failTwice), std::bad_alloc);
  }
  else
  {
    EXPECT_THROW(team.run(failTwice), TeamError);
  }
  // All processes are at the same place again.
  std::array<std::int64_t, 1> ones{ 1 };
  team.run([&] { team.sum(std::span<std::int64_t>(ones)); });
  EXPECT_EQ(ones[0], sizeOfTest());
}

TEST(DistributedFailures, OfOtherUsersOfHypreAreNotOurs)
{
  if (rankOfTest() == sizeOfTest() - 1)
  {
    HYPRE_IJMatrixAssemble(nullptr);
    ASSERT_NE(HYPRE_GetError(), 0);
  }
  EXPECT_EQ(
    messageOfSolve(0, [](CellBatch&) { throw Error("the disk is full"); }), "the disk is full");
}

TEST(DistributedFailures, OfSeveralProcessesIsTheFirstOne)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, rankOfTest(),
    [](CellBatch&) { throw Error("process " + std::to_string(rankOfTest()) + " fails"); });
  EXPECT_EQ(messageOf([&] { solver.solve(problem); }), "process 0 fails");
}

TEST(DistributedFailures, WithoutMemory)
{
  const int last = sizeOfTest() - 1;
  EXPECT_EQ(messageOfSolve(last, [](CellBatch&) { throw std::bad_alloc(); }),
    "process " + std::to_string(last) + " of " + std::to_string(last + 1) + " is out of memory");

  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, -1, {});
  DistributedOptions options;
  options.memoryLimit = rankOfTest() == last ? 1000 : INT64_MAX;
  expectError([&] { solver.solve(problem, options); }, "raise the memory limit");
}

TEST(DistributedFailures, OfALimitBelowTheEstimateOfOneProcess)
{
  for (const StreamMesh& mesh : { patch(120, 110), block(28, 26, 24) })
  {
    const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
    const StreamMesh own = meshOf(part);
    DistributedSolver solver(MPI_COMM_WORLD, part);
    FailingProblem problem(own, -1, {});
    const double estimate = partMemory(own.vertices(), own.cells(), 1);
    DistributedOptions options;
    options.memoryLimit = static_cast<std::int64_t>(estimate) + 1;
    const Report report = solver.solve(problem, options).report;
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.pool_bytes_peak, options.memoryLimit);
    options.memoryLimit -= rankOfTest() == sizeOfTest() - 1 ? 2 : 0;
    expectError([&] { solver.solve(problem, options); }, "more than the memory limit");
  }
}

TEST(DistributedFailures, OfProcessesThatAreAskedDifferently)
{
  if (sizeOfTest() == 1)
  {
    GTEST_SKIP() << "there is one process";
  }
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  const bool isOther = rankOfTest() == sizeOfTest() - 1;
  FailingProblem problem(own, -1, {});
  DistributedOptions options;
  options.tolerance = isOther ? 1e-2 : 1e-8;
  expectError([&] { solver.solve(problem, options); }, "do not have the same tolerance");
  options = {};
  options.maxIterations = isOther ? 3 : 4;
  expectError([&] { solver.solve(problem, options); }, "do not have the same");
  ElementProblem columns(own);
  columns.Columns = isOther ? 1 : 2;
  expectError([&] { solver.solve(columns); }, "do not have the same");
}

TEST(DistributedFailures, OfDataThatAreNoNumbers)
{
  const int last = sizeOfTest() - 1;
  const std::string message = messageOfSolve(
    last, [](CellBatch& batch) { batch.source[0] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_TRUE(contains(message, "the source of cell")) << message;
}

TEST(DistributedFailures, OfHandles)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  DistributedSolver solver(MPI_COMM_WORLD, part);
  const auto messageWith = [&](const std::function<void(ArrayHandles&, std::size_t)>& set)
  {
    ArrayHandles handles(static_cast<std::int64_t>(part.ids.size()));
    for (std::size_t k = 0; k < part.ids.size(); ++k)
    {
      if (part.ids[k] == mesh.vertices() - 1)
      {
        set(handles, k);
      }
    }
    return messageOf([&] { solver.deform(handles); });
  };
  const std::string vertex = "vertex " + std::to_string(mesh.vertices() - 1);
  EXPECT_TRUE(contains(messageWith([](ArrayHandles&, std::size_t) {}), "no vertex of the mesh"));
  EXPECT_TRUE(contains(messageWith(
                         [](ArrayHandles& handles, std::size_t k)
                         {
                           handles.Values.mask[k] = 1;
                           handles.Values.target[3 * k] = NAN;
                         }),
    "target that a handle gives to " + vertex));
  EXPECT_TRUE(contains(messageWith(
                         [](ArrayHandles& handles, std::size_t k)
                         {
                           handles.Values.mask[k] = 1;
                           handles.Values.target[3 * k] = 1e200;
                         }),
    "leaves the range of numbers"));
}

TEST(DistributedFailures, OfTheMemoryOfADeformation)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  ArrayHandles handles(static_cast<std::int64_t>(part.ids.size()));
  DistributedSolver solver(MPI_COMM_WORLD, part);
  DistributedOptions options;
  // Both steps have seven right-hand sides.
  const auto cells = static_cast<std::int64_t>(part.block.corners.size()) / 3;
  options.memoryLimit =
    static_cast<std::int64_t>(partMemory(static_cast<std::int64_t>(part.ids.size()), cells, 6));
  expectError([&] { solver.deform(handles, Weights::Clamped, options); }, "memory limit");
}

TEST(DistributedFailures, OfPartsThatAreNotValid)
{
  const StreamMesh mesh = meshOfTest();
  const std::vector<std::int64_t> cuts = evenCuts(mesh.cells(), sizeOfTest());
  const int last = sizeOfTest() - 1;
  const auto messageWith = [&](const std::function<void(MeshPart&)>& damage)
  {
    MeshPart part = partOf(mesh, cuts);
    if (rankOfTest() == last)
    {
      damage(part);
    }
    return messageOf([&] { const DistributedSolver solver(MPI_COMM_WORLD, part); });
  };
  EXPECT_TRUE(contains(
    messageWith([](MeshPart& part) { part.block.positions[4] = NAN; }), "is not a finite number"));
  EXPECT_TRUE(contains(messageWith([](MeshPart& part) { part.block.corners[2] = 1 << 30; }),
    "uses a vertex that the part does not have"));
  EXPECT_TRUE(contains(messageWith([](MeshPart& part) { std::swap(part.ids[0], part.ids[1]); }),
    "its vertices must ascend"));
  EXPECT_TRUE(contains(messageWith([](MeshPart& part) { ++part.firstOwned; }), "do not fit"));
  EXPECT_TRUE(contains(messageWith([](MeshPart& part) { part.endOwned += 3; }), "do not fit"));
}

TEST(DistributedFailures, OfOptions)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, -1, {});
  DistributedOptions options;
  options.tolerance = 1.0;
  expectError([&] { solver.solve(problem, options); }, "the tolerance must lie between 0 and 1");
  options = {};
  options.maxIterations = 0;
  expectError([&] { solver.solve(problem, options); }, "at least one iteration");
}

TEST(DistributedFailures, TooFewIterationsAreNoError)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, -1, {});
  DistributedOptions options;
  options.tolerance = 1e-12;
  options.maxIterations = 1;
  const Report report = solver.solve(problem, options).report;
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.cycles, 1);
  EXPECT_TRUE(hasNote(report, "not converged"));
}

TEST(DistributedFailures, TheFirstProcessMayCancel)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, -1, {});
  DistributedOptions options;
  options.progress = [](double done) { return done < 0.3; };
  EXPECT_THROW(solver.solve(problem, options), Cancelled);
}

TEST(DistributedFailures, OfTheUseOfASolution)
{
  const StreamMesh mesh = meshOfTest();
  const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  FailingProblem problem(own, -1, {});
  const DistributedSolution solution = solver.solve(problem);
  const auto fail = [](Solution& whole)
  {
    std::vector<double> some(3);
    whole.read(whole.vertices() - 3, 3, some);
    throw Error("the result cannot be written");
  };
  expectError([&] { solver.gather(solution, fail); }, "the result cannot be written");
  expectError(
    [&]
    {
      solver.gather(solution,
        [](Solution& whole)
        {
          std::vector<double> some(3);
          whole.read(whole.vertices() - 2, 3, some);
        });
    },
    "vert");
}

} // namespace smg::testing
