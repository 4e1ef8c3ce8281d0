// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/AtOnce.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolutionRanges.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

// Streaming equals the in-core method bit for bit, for all windows.

namespace smg::testing
{
namespace
{

/** Surfaces and solids in a good and in a random order, with all weights; many vertices of the flat
 * tetrahedra and of the chains of slivers form patches. */
std::vector<std::pair<StreamMesh, ArrayProblem>> tasks()
{
  std::vector<std::pair<StreamMesh, ArrayProblem>> list;
  const IndexedTestMesh surface = shuffled(torus(110, 60, 0.4));
  const IndexedTestMesh solid = shuffled(tetBox(16, 15, 17, 0.15));
  const auto add = [&](const IndexedTestMesh& mesh, TestOrder order, int columns, Weights weights)
  {
    StreamMesh stream = toStream(mesh, order);
    ArrayProblem problem = heldEnds(stream, columns, weights);
    list.emplace_back(std::move(stream), std::move(problem));
  };
  add(surface, TestOrder::BreadthFirst, 3, Weights::Clamped);
  add(surface, TestOrder::Keep, 1, Weights::Uniform);
  add(solid, TestOrder::BreadthFirst, 1, Weights::Clamped);
  add(solid, TestOrder::Keep, 3, Weights::Uniform);
  add(grid(5000, 2), TestOrder::BreadthFirst, 5, Weights::Uniform);
  const IndexedTestMesh flat = shuffled(tetBox(18, 18, 17, 0.33));
  add(flat, TestOrder::BreadthFirst, 3, Weights::Cotangent);
  add(flat, TestOrder::Keep, 1, Weights::Cotangent);
  add(shuffled(sliverChains(90, 60, 1e-3)), TestOrder::BreadthFirst, 1, Weights::Cotangent);
  return list;
}

SolveOptions shortSolve()
{
  SolveOptions options;
  options.tolerance = 1e-12;
  options.maxCycles = 3;
  return options;
}

Solved inCore(const StreamMesh& mesh, ArrayProblem problem)
{
  SolveOptions options = shortSolve();
  options.inCore = true;
  return solveMesh(mesh, problem, options);
}

} // namespace

TEST(Streaming, EqualsInCoreBitForBit)
{
  Combinations chosen;
  for (auto& [mesh, problem] : tasks())
  {
    const Solved expected = inCore(mesh, problem);
    for (const std::int64_t coreNodes : { 0, 500, 50000 })
    {
      for (const std::int64_t blockNodes : { 64, 1000, 4096, 1 << 20 })
      {
        if (!chosen.next())
        {
          continue;
        }
        SolveOptions options = shortSolve();
        options.coreNodes = coreNodes;
        options.blockNodes = blockNodes;
        const Solved solved = solveMesh(mesh, problem, options);
        EXPECT_TRUE(sameBits(solved.values, expected.values))
          << coreNodes << " core nodes, blocks of " << blockNodes;
        EXPECT_EQ(solved.report.residuals, expected.report.residuals);
        EXPECT_GT(solved.report.bytes_written, 0);
      }
    }
    EXPECT_EQ(expected.report.bytes_written, 0);
  }
}

TEST(Streaming, DoesNotDependOnHowTheMeshComesInBlocks)
{
  Combinations chosen;
  for (auto& [mesh, problem] : tasks())
  {
    const Solved expected = inCore(mesh, problem);
    for (const std::int64_t blockCells : { 1, 17, 5000, 1 << 20 })
    {
      if (!chosen.next())
      {
        continue;
      }
      SolveOptions options = shortSolve();
      options.coreNodes = 500;
      options.threads = 8;
      EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options, blockCells).values, expected.values))
        << "blocks of " << blockCells << " cells";
    }
  }
}

TEST(Streaming, DoesNotDependOnTheNumberOfThreads)
{
  Combinations chosen;
  for (auto& [mesh, problem] : tasks())
  {
    const Solved expected = inCore(mesh, problem);
    for (const int threads : { 1, 2, 3, 8, 16 })
    {
      for (const bool core : { false, true })
      {
        if (!chosen.next())
        {
          continue;
        }
        SolveOptions options = shortSolve();
        options.coreNodes = 500;
        options.threads = threads;
        options.inCore = core;
        const Solved solved = solveMesh(mesh, problem, options);
        EXPECT_TRUE(sameBits(solved.values, expected.values)) << threads << " threads";
        EXPECT_GE(solved.report.threads, 1);
        EXPECT_LE(solved.report.threads, threads);
      }
    }
  }
}

TEST(Streaming, EqualsInCoreForEveryNumberOfSweeps)
{
  auto [mesh, problem] = tasks()[0];
  for (const int sweeps : { 1, 3, 7 })
  {
    SolveOptions options = shortSolve();
    options.sweeps = sweeps;
    options.coreNodes = 500;
    const Solved streaming = solveMesh(mesh, problem, options);
    options.inCore = true;
    EXPECT_TRUE(sameBits(streaming.values, solveMesh(mesh, problem, options).values));
  }
}

TEST(Streaming, EqualsInCoreWithSourcesTargetsScreeningAndFreeComponents)
{
  const IndexedTestMesh one = torus(90, 40, 0.3);
  const StreamMesh mesh = toStream(shuffled(disjointUnion(one, sphere(4), { 0, 0, 8 })));
  ArrayProblem problem = heldEnds(mesh, 2, Weights::Clamped);
  problem.Source.resize(2 * mesh.vertices());
  Random random(3);
  for (double& source : problem.Source)
  {
    source = random.uniform(-1, 1);
  }
  problem.Target = [](const double* p, const double* q, double* d)
  {
    d[0] = p[0] * q[1] - p[1] * q[0];
    d[1] = p[2] - q[2];
  };
  for (const double screening : { 0.0, 0.5 })
  {
    problem.Screening = screening;
    const Solved expected = inCore(mesh, problem);
    EXPECT_EQ(expected.report.free_components, screening == 0.0 ? 1 : 0);
    SolveOptions options = shortSolve();
    options.coreNodes = 0;
    options.blockNodes = 500;
    EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options).values, expected.values));
  }
}

TEST(Streaming, DoesKCyclesInKPlusOnePasses)
{
  auto [mesh, problem] = tasks()[0];
  for (const int cycles : { 1, 2, 5 })
  {
    for (const bool core : { false, true })
    {
      SolveOptions options = shortSolve();
      options.maxCycles = cycles;
      options.inCore = core;
      options.coreNodes = 500;
      const Report report = solveMesh(mesh, problem, options).report;
      EXPECT_EQ(report.cycles, cycles);
      EXPECT_EQ(report.passes, cycles + 1);
      EXPECT_EQ(report.residuals.size(), static_cast<std::size_t>(cycles));
    }
  }
}

TEST(Streaming, AsksTheMeshAndTheProblemOnTheThreadThatSolves)
{
  struct ThreadCheckingSource : MemorySource
  {
    using MemorySource::MemorySource;
    bool readsOnAnyThread() const override { return false; }
    bool next(MeshBlock& block) override
    {
      EXPECT_EQ(std::this_thread::get_id(), this->Thread);
      return MemorySource::next(block);
    }
    std::thread::id Thread = std::this_thread::get_id();
  };
  struct ThreadCheckingProblem : ArrayProblem
  {
    using ArrayProblem::ArrayProblem;
    void conditions(const MeshBlock& block, VertexConditions& conditions) override
    {
      EXPECT_EQ(std::this_thread::get_id(), this->Thread);
      ArrayProblem::conditions(block, conditions);
    }
    std::thread::id Thread = std::this_thread::get_id();
  };
  auto [mesh, given] = tasks()[0];
  ThreadCheckingProblem problem;
  static_cast<ArrayProblem&>(problem) = given;
  ThreadCheckingSource source(mesh, 50);
  SolveOptions options = shortSolve();
  options.threads = 4;
  EXPECT_EQ(solve(source, problem, options)->report().vertices, mesh.vertices());
}

/** The passes add up to the solve, and each has the residual of its V-cycle. */
void expectPassesToAgree(const Report& report)
{
  ASSERT_EQ(std::ssize(report.by_pass), report.passes);
  std::int64_t read = 0, written = 0;
  double seconds = 0.0;
  for (std::size_t k = 0; k < report.by_pass.size(); ++k)
  {
    const Report::Pass& pass = report.by_pass[k];
    EXPECT_EQ(pass.residual, k == 0 ? 1.0 : report.residuals[k - 1]);
    EXPECT_GT(pass.seconds, 0.0);
    EXPECT_LE(pass.pool_bytes, report.pool_bytes_peak);
    read += pass.read;
    written += pass.written;
    seconds += pass.seconds;
  }
  EXPECT_LE(seconds, report.seconds.total);
  EXPECT_EQ(read, report.bytes_read);
  EXPECT_EQ(written, report.bytes_written);
}

TEST(Streaming, TellsItsTrafficByKind)
{
  auto [mesh, problem] = tasks()[0];
  const auto after = [&, &mesh = mesh, &problem = problem](int cycles)
  {
    SolveOptions options = shortSolve();
    options.maxCycles = cycles;
    options.coreNodes = 500;
    options.acceleration = AccelerationKind::None; // it has separate files
    return solveMesh(mesh, problem, options).report;
  };
  const Report reports[] = { after(1), after(2), after(3) };
  for (const Report& report : reports)
  {
    std::int64_t read = 0, written = 0;
    for (const Report::Traffic& traffic : report.bytes_by_kind)
    {
      read += traffic.read;
      written += traffic.written;
    }
    EXPECT_EQ(read, report.bytes_read);
    EXPECT_EQ(written, report.bytes_written);
    expectPassesToAgree(report);
  }
  const auto& [one, two, three] = reports;
  ASSERT_EQ(one.bytes_by_kind.size(), three.bytes_by_kind.size());
  for (std::size_t k = 0; k < one.bytes_by_kind.size(); ++k)
  {
    const Report::Traffic& first = one.bytes_by_kind[k];
    const std::int64_t pass = two.bytes_by_kind[k].read - first.read;
    const std::int64_t writing = two.bytes_by_kind[k].written - first.written;
    EXPECT_EQ(three.bytes_by_kind[k].read, first.read + 2 * pass) << first.kind << first.level;
    if (first.kind == "state")
    {
      EXPECT_GT(writing, 0) << first.level; // anew in every pass
    }
    else
    {
      EXPECT_EQ(writing, 0) << first.kind << first.level; // once
    }
    if (first.kind == "right_side")
    {
      // Blocks of zeros, away from the constraints, take no space.
      EXPECT_GT(pass, 0);
      EXPECT_LT(pass, mesh.vertices() * problem.Columns * std::int64_t(sizeof(double)));
    }
    if (first.kind == "rows")
    {
      EXPECT_GT(pass, 0) << first.level;
      EXPECT_EQ(pass, first.written) << first.level;
    }
  }
}

TEST(Streaming, AcceptsMoreThanTheCountsThatTheSourceClaimsAndRefusesFewer)
{
  /** A mesh whose source declares a wrong number of vertices. */
  class Claiming : public MemorySource
  {
  public:
    Claiming(const StreamMesh& mesh, std::int64_t vertices)
      : MemorySource(mesh)
      , Claimed(MemorySource::info())
    {
      this->Claimed.vertices = vertices;
      this->Claimed.width = this->Claimed.span = -1;
    }
    const StreamInfo& info() const override { return this->Claimed; }

  private:
    StreamInfo Claimed;
  };
  auto [mesh, problem] = tasks()[0];
  const Solved expected = inCore(mesh, problem);
  SolveOptions options = shortSolve();
  options.coreNodes = 500;
  for (const std::int64_t vertices : { -1, 10 })
  {
    Claiming source(mesh, vertices);
    const std::unique_ptr<Solution> solution = solve(source, problem, options);
    EXPECT_TRUE(sameBits(valuesOf(*solution), expected.values)) << vertices << " claimed";
  }
  for (const std::int64_t vertices : { mesh.vertices() + 1, std::int64_t(1) << 40 })
  {
    Claiming source(mesh, vertices);
    expectError([&] { solve(source, problem, options); }, "the mesh stream ends early");
  }
}

TEST(Streaming, TakesBlocksOfVerticesOrOfCellsOnly)
{
  const auto [mesh, given] = tasks()[2];
  ArrayProblem problem = given;
  MemorySource source(mesh, 50);
  std::vector<MeshBlock> blocks;
  MeshBlock block;
  while (source.next(block))
  {
    MeshBlock vertices = block;
    vertices.corners.clear();
    vertices.finalized = blocks.empty() ? 0 : blocks.back().finalized;
    MeshBlock cells = block;
    cells.firstVertex += cells.vertices();
    cells.positions.clear();
    blocks.push_back(vertices);
    blocks.push_back(cells);
  }
  BlockSource split(mesh.cellType, blocks);
  const std::unique_ptr<Solution> solution = solve(split, problem, shortSolve());
  EXPECT_TRUE(sameBits(valuesOf(*solution), inCore(mesh, problem).values));
}

TEST(Streaming, TwoSolvesAtOnceDoNotDisturbEachOther)
{
  const auto list = tasks();
  std::vector<Solved> results(2);
  runAtOnce(2,
    [&](int k)
    {
      ArrayProblem problem = list[k].second;
      SolveOptions options = shortSolve();
      options.coreNodes = 500;
      results[k] = solveMesh(list[k].first, problem, options);
    });
  for (const int k : { 0, 1 })
  {
    EXPECT_TRUE(sameBits(results[k].values, inCore(list[k].first, list[k].second).values));
  }
}

TEST(Streaming, LeavesNoScratchFileBehind)
{
  const TemporaryFolder folder;
  auto [mesh, problem] = tasks()[0];
  SolveOptions options = shortSolve();
  options.scratch = folder.path();
  options.coreNodes = 500;
  {
    MemorySource source(mesh);
    const std::unique_ptr<Solution> solution = solve(source, problem, options);
    EXPECT_GT(folder.entries(), 0);
  }
  EXPECT_EQ(folder.entries(), 0);
  options.inCore = true;
  MemorySource source(mesh);
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Solution, RangesInAnyOrderAreTheWhole)
{
  for (auto& [mesh, problem] : tasks())
  {
    for (const bool core : { false, true })
    {
      SolveOptions options = shortSolve();
      options.inCore = core;
      MemorySource source(mesh);
      const std::unique_ptr<Solution> solution = solve(source, problem, options);
      EXPECT_EQ(solution->columns(), problem.Columns);
      expectRangesOfTheWhole(*solution);
    }
  }
}

TEST(Solution, ARangeOutsideIsAnError)
{
  auto [mesh, problem] = tasks()[0];
  MemorySource source(mesh);
  const std::unique_ptr<Solution> solution = solve(source, problem, shortSolve());
  std::vector<double> values(3 * solution->vertices() + 3);
  EXPECT_THROW(solution->read(-1, 2, values), Error);
  EXPECT_THROW(solution->read(0, -1, values), Error);
  EXPECT_THROW(solution->read(0, solution->vertices() + 1, values), Error);
  EXPECT_THROW(solution->read(solution->vertices(), 1, values), Error);
  EXPECT_THROW(solution->read(INT64_MAX - 1, 5, values), Error);
  EXPECT_THROW(solution->read(0, 10, std::span(values).first(29)), Error);
}

} // namespace smg::testing
