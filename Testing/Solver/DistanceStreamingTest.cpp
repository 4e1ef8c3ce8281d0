// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Solver/MemoryGrowth.h"
#include "Testing/Solver/MemoryLimits.h"
#include "Testing/Support/SolutionRanges.h"

#include <gtest/gtest.h>

#include <cmath>

// The distances do not depend on blocks, memory or, up to the tolerance, the window; memory grows
// with the width of the stream.

namespace smg::testing
{
namespace
{

DistanceDescription allOf(std::vector<std::int64_t> sources)
{
  DistanceDescription description = fromVertices(std::move(sources));
  description.source = description.direction = true;
  return description;
}

} // namespace

TEST(DistanceStreaming, DoesNotDependOnBlocksAndMemory)
{
  for (const IndexedTestMesh& indexed : { torus(200, 120, 0.1), unitCube(12) })
  {
    const StreamMesh stream = toStream(indexed);
    const DistanceDescription description = allOf({ 5, 6, 1500 });
    const Solved whole = measure(MemoryMesh(stream), description);
    for (const std::int64_t blockCells : { 37, 100000000 })
    {
      const MemoryMesh mesh(stream, blockCells);
      EXPECT_TRUE(sameBits(measure(mesh, description).values, whole.values));
    }
    DistanceOptions options;
    options.memoryLimit = whole.report.pool_bytes_peak;
    EXPECT_TRUE(sameBits(measure(MemoryMesh(stream), description, options).values, whole.values));
  }
}

TEST(DistanceStreaming, DependsOnTheWindowByTheTolerance)
{
  for (const StreamMesh& stream :
    { toStream(torus(200, 150, 0.1)), toStream(tetBox(8, 8, 80, 0.1), TestOrder::Keep) })
  {
    // From the middle of the stream, so that both directions are needed.
    const MemoryMesh mesh(stream);
    const DistanceDescription description =
      fromVertices({ mesh.mesh().vertices() / 2, mesh.mesh().vertices() / 3 });
    const Solved whole = measure(mesh, description);
    const Solved windowed = measureInChunks(mesh, description, 1);
    EXPECT_EQ(whole.report.passes, 1);
    EXPECT_GT(windowed.report.passes, 1);
    EXPECT_LT(windowed.report.peak_nodes, whole.report.peak_nodes);
    EXPECT_LT((windowed.values - whole.values).cwiseAbs().maxCoeff(),
      2e-6 * whole.report.distance->maximum);
  }
}

TEST(DistanceStreaming, OfACurveDependsOnTheWindowLittle)
{
  const MemoryMesh mesh(toStream(torus(200, 150, 0.1)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::Sphere{ { 3, 0, 0 }, 0.5 }));
  const Solved whole = measure(mesh, description);
  const Solved windowed = measureInChunks(mesh, description, 1);
  EXPECT_GT(windowed.report.passes, 1);
  EXPECT_LT(
    (windowed.values - whole.values).cwiseAbs().maxCoeff(), 1e-4 * whole.report.distance->maximum);
}

TEST(DistanceStreaming, DoesNotReadWhatCannotChange)
{
  // The front of the second pass is at one end only.
  const MemoryMesh mesh(toStream(grid(20, 3000)));
  const Solved solved = measureInChunks(mesh, fromVertices({ 30000 }), 1000);
  EXPECT_EQ(solved.report.passes, 2);
  EXPECT_LT(solved.report.distance->mesh_readings, 1.2);
}

TEST(DistanceStreaming, AnswersRanges)
{
  const MemoryMesh mesh(toStream(torus(60, 40)));
  const auto solution = pathDistance(
    mesh, allOf({ 11 }), std::make_unique<DistanceRun>(DistanceOptions()), "distance", 200);
  expectRangesOfTheWhole(*solution);
}

TEST(DistanceStreaming, MeasuresASpanThatIsNotKnown)
{
  MemoryMesh mesh(toStream(torus(60, 40)));
  const Solved known = measure(mesh, fromVertices({ 11 }));
  const int readings = mesh.readings();
  mesh.info().span = mesh.info().vertices = mesh.info().cells = -1;
  EXPECT_TRUE(sameBits(measure(mesh, fromVertices({ 11 })).values, known.values));
  EXPECT_EQ(readings, 1);
  EXPECT_EQ(mesh.readings(), 3);
}

TEST(DistanceStreaming, MemoryOfASurfaceIsTheSquareRoot)
{
  // The chunks of these sizes follow from the span.
  const auto run = [](const StreamMesh& mesh)
  {
    const MemoryMesh stored(mesh);
    return measureInChunks(stored, fromVertices({ 0 }), 4 * stored.info().span).report;
  };
  expectGrowth(run, { toStream(torus(316, 158)), toStream(torus(632, 316)) }, 2.2, 2.4);
}

TEST(DistanceStreaming, StaysWithinItsLimit)
{
  const MemoryMesh mesh(toStream(torus(300, 200)));
  DistanceOptions options;
  options.memoryLimit = 1;
  expectLimitsKept(options, 1 << 25,
    [&](const DistanceOptions& limited)
    { return measureInChunks(mesh, allOf({ 7 }), 4000, limited).report; });
}

TEST(DistanceStreaming, RefusesALimitBeforeItReads)
{
  const MemoryMesh mesh(toStream(torus(300, 200)));
  DistanceOptions options;
  options.memoryLimit = 1 << 20;
  const std::string sentence = scratchErrorOf(
    options, [&](const DistanceOptions& limited) { distance(mesh, fromVertices({ 7 }), limited); });
  EXPECT_TRUE(contains(sentence, "a distance needs at least")) << sentence;
  EXPECT_TRUE(contains(sentence, "(1048576 bytes)")) << sentence;
  EXPECT_EQ(mesh.readings(), 0);
}

TEST(DistanceStreaming, ReportsWhatIsNotSettled)
{
  const MemoryMesh mesh(toStream(torus(200, 150)));
  DistanceOptions options;
  options.maxPasses = 1;
  const Solved solved =
    measureInChunks(mesh, fromVertices({ mesh.mesh().vertices() / 2 }), 1, options);
  EXPECT_EQ(solved.report.passes, 1);
  EXPECT_FALSE(solved.report.converged);
  EXPECT_GT(solved.report.distance->unsettled, 0);
  EXPECT_EQ(solved.report.notes.size(), 1U);
}

} // namespace smg::testing
