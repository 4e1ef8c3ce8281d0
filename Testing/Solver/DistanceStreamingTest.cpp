// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"

#include <gtest/gtest.h>

#include <cmath>

// The distances depend on the window by the tolerance alone.

namespace smg::testing
{

TEST(DistanceStreaming, DependsOnTheWindowByTheTolerance)
{
  for (const StreamMesh& stream :
    { toStream(torus(200, 150, 0.1)), toStream(tetBox(8, 8, 80, 0.1), TestOrder::Keep) })
  {
    // From the middle of the stream, so that both directions are needed.
    const MemoryMesh mesh(stream);
    const std::int64_t middle = mesh.mesh().vertices() / 2;
    const auto of = [](std::vector<std::int64_t> ids)
    {
      DistanceDescription description = fromVertices(std::move(ids));
      description.accuracy = PathAccuracy::Approximate; // see DistanceLaws for exact ones
      return description;
    };
    const Solved whole = measure(mesh, of({ middle }));
    const Solved windowed = measureInChunks(mesh, of({ middle }), 1);
    EXPECT_EQ(whole.report.passes, 1);
    EXPECT_GT(windowed.report.passes, 1);
    EXPECT_LT(windowed.report.peak_nodes, whole.report.peak_nodes);
    EXPECT_LT((windowed.values - whole.values).cwiseAbs().maxCoeff(),
      1e-3 * whole.report.distance->maximum);
    // Where the fronts of several points meet, that which comes first is passed on.
    const Solved both = measure(mesh, of({ middle, mesh.mesh().vertices() / 3 }));
    const Solved parts = measureInChunks(mesh, of({ middle, mesh.mesh().vertices() / 3 }), 1);
    EXPECT_LT(
      (parts.values - both.values).cwiseAbs().maxCoeff(), 0.01 * both.report.distance->maximum);
  }
}

TEST(DistanceStreaming, OfACurveDependsOnTheWindowLittle)
{
  const MemoryMesh mesh(toStream(torus(200, 150, 0.1)));
  DistanceDescription description;
  description.from.emplace_back(Region(Region::Sphere{ { 3, 0, 0 }, 0.5 }));
  description.accuracy = PathAccuracy::Approximate;
  const Solved whole = measure(mesh, description);
  const Solved windowed = measureInChunks(mesh, description, 1);
  EXPECT_GT(windowed.report.passes, 1);
  EXPECT_LT(
    (windowed.values - whole.values).cwiseAbs().maxCoeff(), 1e-3 * whole.report.distance->maximum);
}

TEST(DistanceStreaming, DoesNotReadWhatCannotChange)
{
  // The front of the second pass is at one end only.
  const MemoryMesh mesh(toStream(grid(20, 3000)));
  const Solved solved = measureInChunks(mesh, fromVertices({ 30000 }), 1000);
  EXPECT_EQ(solved.report.passes, 2);
  EXPECT_LT(solved.report.distance->mesh_readings, 1.2);
}

TEST(DistanceStreaming, MeasuresASpanThatIsNotKnown)
{
  MemoryMesh mesh(toStream(torus(60, 40)));
  DistanceDescription description = fromVertices({ 11 });
  description.accuracy = PathAccuracy::Approximate; // as where the size is not known
  const Solved known = measure(mesh, description);
  const int readings = mesh.readings();
  mesh.info().span = mesh.info().vertices = mesh.info().cells = -1;
  EXPECT_TRUE(sameBits(measure(mesh, description).values, known.values));
  EXPECT_EQ(readings, 1);
  EXPECT_EQ(mesh.readings(), 3);
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
