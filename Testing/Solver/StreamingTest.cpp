// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

// What a streaming solve asks of its source, and tells of its passes.

namespace smg::testing
{
namespace
{

/** A surface, and a problem with three columns. */
std::pair<StreamMesh, ArrayProblem> task()
{
  StreamMesh mesh = toStream(shuffled(torus(110, 60, 0.4)));
  ArrayProblem problem = heldEnds(mesh, 3, Weights::Clamped);
  return { std::move(mesh), std::move(problem) };
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

TEST(Streaming, DoesKCyclesInKPlusOnePasses)
{
  auto [mesh, problem] = task();
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
  auto [mesh, given] = task();
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
    // The first one is that of the initial values.
    EXPECT_EQ(pass.residual, k == 0 ? pass.residual : report.residuals[k - 1]);
    EXPECT_GT(pass.residual, 0.0);
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
  auto [mesh, problem] = task();
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
  auto [mesh, problem] = task();
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
  const auto [mesh, given] = task();
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

} // namespace smg::testing
