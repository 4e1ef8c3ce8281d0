// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Pool.h"
#include "Testing/Solver/AllJobs.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/ScratchError.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

// The memory of every job stays within its limit, and grows with the width of the stream, not with
// the mesh: like the square root of the number of vertices for surfaces, and like its 2/3 power for
// solids.

namespace smg::testing
{
namespace
{

class JobLimitLaw : public JobTest
{
protected:
  StreamMesh someMesh() const
  {
    return toStream(this->job().ofSurfaces ? torus(140, 70, 0.3) : tetBox(20, 20, 20, 0.15));
  }
  Way someWay() const
  {
    Way way;
    way.coreNodes = 1000;
    return way;
  }
};

/** The first number of MiB in an error of a limit, as bytes. */
std::int64_t namedLimit(const std::string& sentence)
{
  for (const char* before : { "needs about ", "needs at least " })
  {
    if (const std::size_t place = sentence.find(before); place != std::string::npos)
    {
      return std::stoll(sentence.substr(place + std::string(before).size())) << 20;
    }
  }
  return 0;
}

/** What the growth holds for: jobs that keep a window of the stream. */
class JobMemoryLaw : public JobLimitLaw
{
protected:
  /** Checks that memory grows by at most the factors `nodes` and `bytes` from mesh to mesh. */
  void expectGrowth(const std::vector<IndexedTestMesh>& meshes, double nodes, double bytes,
    TestOrder order = TestOrder::BreadthFirst)
  {
    Report before;
    for (const IndexedTestMesh& mesh : meshes)
    {
      const Report report = JobOnMesh(this->job(), toStream(mesh, order))(this->someWay()).report;
      if (before.vertices > 0)
      {
        EXPECT_LE(
          static_cast<double>(report.peak_nodes), nodes * static_cast<double>(before.peak_nodes))
          << mesh.vertices() << " vertices";
        EXPECT_LE(static_cast<double>(report.pool_bytes_peak),
          bytes * static_cast<double>(before.pool_bytes_peak))
          << mesh.vertices() << " vertices";
      }
      before = report;
    }
  }
};

} // namespace

TEST_P(JobLimitLaw, StaysWithinTheLimit)
{
  const JobOnMesh run(this->job(), this->someMesh());
  Way way = this->someWay();
  int done = 0;
  for (way.memoryLimit = 1 << 18; done < 3; way.memoryLimit *= 2)
  {
    ASSERT_LE(way.memoryLimit, 1 << 28) << "no limit is enough";
    Report report;
    bool isOfMemory = false;
    const auto attempt = [&]
    {
      try
      {
        report = run(way).report;
      }
      catch (const MemoryError&)
      {
        isOfMemory = true;
        throw;
      }
    };
    if (messageOf(attempt).empty())
    {
      ++done;
      EXPECT_LE(report.pool_bytes_peak, way.memoryLimit);
    }
    else
    {
      EXPECT_EQ(done, 0) << "more memory is enough, too";
      EXPECT_TRUE(isOfMemory);
    }
  }
}

/** The figure in MiB, as users follow it: rounded up, for all of the job. */
TEST_P(JobLimitLaw, TheLimitThatAnErrorNamesSuffices)
{
  const JobOnMesh run(this->job(), this->someMesh());
  for (const bool inCore : { false, true })
  {
    Way way = this->someWay();
    way.inCore = inCore && this->job().inCore;
    bool isEnough = false;
    std::int64_t sufficient = 0;
    for (std::int64_t limit = 1 << 18; !isEnough; limit *= 2)
    {
      ASSERT_LE(limit, 1 << 28) << "no limit is enough";
      way.memoryLimit = limit;
      const std::string sentence = messageOf([&] { run(way); });
      isEnough = sentence.empty();
      if (!isEnough && namedLimit(sentence) != sufficient)
      {
        way.memoryLimit = sufficient = namedLimit(sentence);
        EXPECT_GT(sufficient, limit) << sentence;
        EXPECT_EQ(messageOf([&] { run(way); }), "") << sentence;
      }
    }
  }
}

TEST_P(JobLimitLaw, ALimitBelowTheNeedIsRefusedWithBothFigures)
{
  const JobOnMesh run(this->job(),
    toStream(this->job().ofSurfaces ? torus(280, 140, 0.3) : tetBox(30, 30, 30, 0.15)));
  for (const bool inCore : { false, true })
  {
    if (inCore && !this->job().inCore)
    {
      continue;
    }
    Way way = this->someWay();
    way.inCore = inCore;
    way.threads = 1; // more of them need more memory, if there is any
    const std::int64_t need = run(way).report.pool_bytes_peak;
    way.memoryLimit = inCore ? need / 2 : need / 4;
    const WatchedMesh mesh(run.mesh(), 1000);
    const std::string sentence =
      scratchErrorOf(way, [&](const Way& limited) { run.solutionOn(mesh, limited); });
    EXPECT_TRUE(contains(sentence, std::to_string(way.memoryLimit) + " bytes")) << sentence;
    EXPECT_TRUE(contains(sentence, "at least")) << sentence;
    EXPECT_TRUE(!this->job().refusesBeforeItReads || mesh.blocks() == 0) << mesh.blocks();
  }
}

TEST_P(JobMemoryLaw, OfASurfaceIsTheSquareRoot)
{
  if (this->job().ofSurfaces)
  {
    this->expectGrowth({ torus(224, 112), torus(448, 224), torus(896, 448) }, 2.2, 2.4);
  }
}

TEST_P(JobMemoryLaw, OfASolidIsThePowerTwoThirds)
{
  // Ordered plane by plane. Coarse rows become longer with the number of levels.
  if (this->job().ofSolids)
  {
    this->expectGrowth({ tetBox(32, 32, 32), tetBox(64, 64, 64) }, 4.4, 6.5, TestOrder::Keep);
  }
}

TEST_P(JobMemoryLaw, OfASolidInBreadthFirstOrderIsSublinear)
{
  // Its fronts are wide: most of the smaller box is in memory at once.
  if (this->job().ofSolids && std::string(this->job().name) == "SolveForOneColumn")
  {
    this->expectGrowth({ tetBox(32, 32, 32), tetBox(64, 64, 64) }, 5.5, 6.5);
  }
}

TEST_P(JobMemoryLaw, OfAStripIsItsWidth)
{
  // Independent of the length, except that every additional level keeps some blocks.
  if (this->job().ofSurfaces)
  {
    this->expectGrowth({ grid(1500, 40), grid(6000, 40) }, 1.25, 1.25);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, JobLimitLaw, ::testing::ValuesIn(kindsOfJobs()), nameOf);
INSTANTIATE_TEST_SUITE_P(Of, JobMemoryLaw,
  ::testing::ValuesIn(jobsWith([](const Job& job) { return job.hasWindow; })), nameOf);

} // namespace smg::testing
