// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/AllJobs.h"
#include "Testing/Support/AtOnce.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/NotNumbers.h"
#include "Testing/Support/ProgressRecord.h"
#include "Testing/Support/ScratchError.h"
#include "Testing/Support/ScratchLimits.h"
#include "Testing/Support/SolutionRanges.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

// What holds for every job, however it runs: the bits of its result, what it leaves, and how it
// ends.

namespace smg::testing
{
namespace
{

class JobLaws : public JobTest
{
protected:
  /** A surface, or a solid if the job is one of solids alone, of some thousand vertices. */
  JobOnMesh onSomeMesh() const
  {
    return { this->job(),
      toStream(this->job().ofSurfaces ? torus(120, 60, 0.3) : tetBox(20, 19, 18, 0.15)) };
  }

  /** Surfaces and solids in a good and in a poor order, some long and narrow, some with many
   * patches of vertices of flat cells. */
  std::vector<StreamMesh> meshes() const
  {
    std::vector<StreamMesh> list;
    const auto add = [&](const IndexedTestMesh& mesh, TestOrder order)
    {
      if (mesh.cellType == CellType::Triangle ? this->job().ofSurfaces : this->job().ofSolids)
      {
        list.push_back(toStream(mesh, order));
      }
    };
    const IndexedTestMesh surface =
      shuffled(disjointUnion(bumpy(torus(90, 50, 0.4), 0.2), torus(20, 10, 0.3), { 0.5, 0.5, 4 }));
    const IndexedTestMesh solid = shuffled(tetBox(12, 16, 19, 0.15));
    const IndexedTestMesh flat = shuffled(tetBox(14, 16, 15, 0.33));
    add(surface, TestOrder::BreadthFirst);
    add(surface, TestOrder::Keep);
    add(grid(1500, 3), TestOrder::BreadthFirst);
    add(shuffled(sliverChains(60, 40, 1e-3)), TestOrder::BreadthFirst);
    add(solid, TestOrder::BreadthFirst);
    add(solid, TestOrder::Keep);
    add(flat, TestOrder::BreadthFirst);
    add(flat, TestOrder::Keep);
    return list;
  }

  /** In scratch files and in memory, as far as the job has these. */
  std::vector<Way> places() const
  {
    std::vector<Way> ways;
    for (const bool inCore : { false, true })
    {
      if (!inCore || this->job().inCore)
      {
        ways.emplace_back().inCore = inCore;
      }
    }
    return ways;
  }
};

/** The laws of all variants of the jobs. */
class JobBits : public JobLaws
{
};

/** The k-th way: neighbouring ones have all pairs of values. */
Way wayOf(int k)
{
  constexpr std::int64_t CoreNodes[] = { 0, 500, 50000 };
  constexpr std::int64_t BlockNodes[] = { 64, 1000, 4096, 1 << 20 };
  constexpr std::int64_t BlockCells[] = { 1, 17, 5000, 1 << 20 };
  constexpr int Threads[] = { 1, 2, 3, 8, 16 };
  Way way;
  way.coreNodes = CoreNodes[k % 3];
  way.blockNodes = BlockNodes[k % 4];
  way.blockCells = BlockCells[(k + k / 4) % 4];
  way.threads = Threads[k % 5];
  return way;
}

std::string textOf(const Way& way)
{
  return std::to_string(way.coreNodes) + " core nodes, blocks of " +
         std::to_string(way.blockNodes) + " nodes and " + std::to_string(way.blockCells) +
         " cells, " + std::to_string(way.threads) + " threads" + (way.inCore ? ", in core" : "");
}

} // namespace

TEST_P(JobBits, BlocksThreadsAndMemoryDoNotMatter)
{
  constexpr int WaysOfAMesh = 3; // of 60: the meshes together see all values of each of them
  Combinations chosen;
  int next = 0;
  for (const StreamMesh& mesh : this->meshes())
  {
    const JobOnMesh run(this->job(), mesh);
    Way plain;
    plain.inCore = this->job().inCore;
    plain.coreNodes = 50000;
    std::optional<Solved> expected;
    for (int k = 0; k < WaysOfAMesh; ++k)
    {
      Way way = wayOf(next++);
      way.inCore = this->job().inCore && k == 2;
      if (!chosen.next())
      {
        continue;
      }
      if (!expected)
      {
        expected = run(plain);
        EXPECT_EQ(expected->report.vertices, mesh.vertices());
        EXPECT_TRUE(!plain.inCore || expected->report.bytes_written == 0);
      }
      SCOPED_TRACE(textOf(way));
      const Solved solved = run(way);
      EXPECT_TRUE(sameBits(solved.values, expected->values)) << mesh.vertices() << " vertices";
      EXPECT_EQ(solved.report.residuals, expected->report.residuals);
      EXPECT_EQ(solved.report.passes, expected->report.passes);
      EXPECT_LE(solved.report.threads, std::max(way.threads, 1));
    }
  }
}

TEST_P(JobLaws, RangesInAnyOrderAreTheWhole)
{
  const JobOnMesh run(this->job(), this->meshes().front()); // of two components, or a solid
  for (const Way& way : this->places())
  {
    const std::unique_ptr<Solution> solution = run.solution(way);
    ASSERT_EQ(solution->vertices(), run.mesh().vertices());
    expectRangesOfTheWhole(*solution);
    std::vector<double> values(static_cast<std::size_t>(10 * solution->columns()));
    for (const auto& [first, count] : { std::pair<std::int64_t, std::int64_t>{ -1, 2 }, { 0, -1 },
           { 0, solution->vertices() + 1 }, { solution->vertices(), 1 }, { INT64_MAX - 1, 5 } })
    {
      EXPECT_THROW(solution->read(first, count, values), Error) << first << ", " << count;
    }
    EXPECT_THROW(solution->read(0, 10, std::span(values).first(values.size() - 1)), Error);
  }
}

TEST_P(JobLaws, TwoAtOnceDoNotDisturbEachOther)
{
  const std::vector<StreamMesh> meshes = this->meshes();
  const JobOnMesh runs[] = { { this->job(), meshes.front() }, { this->job(), meshes.back() } };
  const Way way = this->places().front();
  Solved results[2];
  runAtOnce(2, [&](int k) { results[k] = runs[k](way); });
  for (int k = 0; k < 2; ++k)
  {
    EXPECT_TRUE(sameBits(results[k].values, runs[k](way).values));
  }
}

TEST_P(JobLaws, LeavesNoScratchFileBehind)
{
  const JobOnMesh run = this->onSomeMesh();
  for (Way way : this->places())
  {
    const TemporaryFolder folder;
    way.scratch = folder.path();
    {
      const std::unique_ptr<Solution> solution = run.solution(way);
      EXPECT_EQ(folder.entries() > 0, !way.inCore);
    }
    EXPECT_EQ(folder.entries(), 0);
  }
}

TEST_P(JobLaws, ProgressRisesToOne)
{
  const JobOnMesh run = this->onSomeMesh();
  for (Way way : this->places())
  {
    ProgressRecord record;
    way.progress = record.function();
    way.blockNodes = 500;
    way.blockCells = 200;
    run.solution(way);
    record.expectRise(this->job().largestStep);
  }
}

TEST_P(JobLaws, CancelledAnywhereItEndsAtOnceAndLeavesNothing)
{
  const TemporaryFolder folder;
  const JobOnMesh run = this->onSomeMesh();
  for (Way way : this->places())
  {
    way.scratch = folder.path();
    way.blockCells = 200;
    for (const double limit : { 0.0, 0.05, 0.15, 0.3, 0.39, 0.45, 0.55, 0.7, 0.9, 1.0 })
    {
      if (way.inCore && limit != 0.3 && limit != 1.0)
      {
        continue;
      }
      bool isRefused = false;
      way.progress = [&](double done)
      {
        EXPECT_FALSE(isRefused) << "goes on";
        isRefused = done >= limit;
        return !isRefused;
      };
      EXPECT_THROW(run.solution(way), Cancelled) << "at " << limit;
      EXPECT_TRUE(isRefused);
      EXPECT_EQ(folder.entries(), 0) << "cancelled at " << limit;
    }
    way.progress = [](double done) -> bool
    { return done < 0.5 ? true : throw std::runtime_error("the caller's own"); };
    EXPECT_THROW(run.solution(way), std::runtime_error);
    EXPECT_EQ(folder.entries(), 0);
  }
}

TEST_P(JobLaws, KeepsTheLimitOfScratchFiles)
{
  const JobOnMesh run = this->onSomeMesh();
  Way way;
  way.scratchLimit = -1;
  expectError([&] { run(way); }, "limit of scratch files");
  if (this->job().inCore)
  {
    way.inCore = true;
    way.scratchLimit = 1;
    EXPECT_EQ(run(way).report.scratch_bytes_peak, 0) << "nothing to limit";
  }
  if (!this->job().hasScratchFiles)
  {
    return;
  }
  struct Limited
  {
    bool same(const Limited& other) const { return sameBits(this->values, other.values); }
    Eigen::MatrixXd values;
    std::int64_t bytes;
  };
  expectScratchLimitKept(Way(),
    [&](const Way& limited)
    {
      const Solved solved = run(limited);
      return Limited{ solved.values, solved.report.scratch_bytes_peak };
    });
}

TEST_P(JobLaws, ErrorsOfTheMeshPassThrough)
{
  const JobOnMesh run = this->onSomeMesh();
  for (Way way : this->places())
  {
    const WatchedMesh whole(run.mesh(), 1000);
    run.solutionOn(whole, way);
    for (const std::int64_t block : { std::int64_t(1), std::int64_t(5), whole.blocks() })
    {
      WatchedMesh mesh(run.mesh(), 1000);
      mesh.damagedBlock = block;
      EXPECT_EQ(scratchErrorOf(way, [&](const Way& scratch) { run.solutionOn(mesh, scratch); }),
        "the file is truncated")
        << block;
    }
  }
}

TEST_P(JobLaws, PointsThatAreNotFiniteAreAnError)
{
  for (const double bad : { NotANumber, Infinite, -Infinite })
  {
    JobOnMesh run = this->onSomeMesh();
    for (const std::int64_t vertex :
      { std::int64_t(0), std::int64_t(333), run.mesh().vertices() - 1 })
    {
      StreamMesh broken = run.mesh();
      broken.positions[static_cast<std::size_t>(3 * vertex + 1)] = bad;
      EXPECT_TRUE(contains(scratchErrorOf(this->places().front(), [&](const Way& way)
                             { run.solutionOn(MemoryMesh(broken, way.blockCells), way); }),
        "finite"))
        << vertex;
    }
  }
}

TEST_P(JobLaws, WaysThatMakeNoSenseAreErrors)
{
  const JobOnMesh run = this->onSomeMesh();
  std::vector<void (*)(Way&)> faults{
    [](Way& way) { way.memoryLimit = 0; },
    [](Way& way) { way.memoryLimit = -5; },
    [](Way& way) { way.threads = -1; },
  };
  if (this->job().inCore)
  {
    faults.push_back([](Way& way) { way.blockNodes = 0; });
    faults.push_back([](Way& way) { way.coreNodes = -1; });
  }
  for (std::size_t k = 0; k < faults.size(); ++k)
  {
    Way way = this->places().front();
    faults[k](way);
    EXPECT_NE(scratchErrorOf(way, run), "") << "fault " << k;
  }
  Way nowhere;
  nowhere.scratch = "/nowhere/at/all";
  expectError([&] { run(nowhere); }, "/nowhere/at/all");
}

/** Cancelled again and again, each time after some reports of progress. */
TEST_P(JobBits, InPartsItHasTheSameBits)
{
  const TemporaryFolder folder;
  const JobOnMesh run = this->onSomeMesh();
  Way way = this->places().front();
  way.coreNodes = 100;
  way.blockNodes = 300;
  const Solved expected = run(way);
  way.checkpoint = folder / "checkpoint";
  if (!this->job().hasCheckpoints)
  {
    if (this->job().inCore) // the others do not even have the option
    {
      expectError([&] { run(way); }, "checkpoint");
      EXPECT_EQ(folder.entries(), 0);
    }
    return;
  }
  int parts = 0;
  for (bool isDone = false; !isDone; ++parts)
  {
    ASSERT_LT(parts, 100);
    int left = 60;
    way.progress = [&](double) { return --left > 0; };
    try
    {
      const std::unique_ptr<Solution> solution = run.solution(way);
      EXPECT_TRUE(sameBits(valuesOf(*solution), expected.values));
      EXPECT_EQ(solution->report().residuals, expected.report.residuals);
      EXPECT_EQ(solution->report().passes, expected.report.passes);
      EXPECT_GT(solution->report().resumed_passes, 0);
      solution->removeCheckpoint();
      EXPECT_TRUE(std::filesystem::exists(way.checkpoint)) << "until the solution is destroyed";
      isDone = true;
    }
    catch (const Cancelled&)
    {
    }
  }
  EXPECT_GE(parts, 2);
  EXPECT_FALSE(std::filesystem::exists(way.checkpoint));
  way.inCore = true;
  expectError([&] { run(way); }, "in core");
}

INSTANTIATE_TEST_SUITE_P(Of, JobBits, ::testing::ValuesIn(AllJobs), nameOf);
INSTANTIATE_TEST_SUITE_P(Of, JobLaws, ::testing::ValuesIn(kindsOfJobs()), nameOf);

} // namespace smg::testing
