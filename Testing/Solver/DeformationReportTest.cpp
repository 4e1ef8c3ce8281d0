// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DeformationTesting.h"

#include <gtest/gtest.h>

// The content of the report of a deformation.

namespace smg::testing
{
namespace
{

/** The residuals of both steps are listed in order, and each step has its last one. */
void expectStepsToAgree(const Report& report)
{
  ASSERT_EQ(report.steps.size(), 2u);
  EXPECT_EQ(report.steps[0].name, "rotation");
  EXPECT_EQ(report.steps[1].name, "position");
  std::size_t end = 0;
  for (const Report::Step& step : report.steps)
  {
    end += static_cast<std::size_t>(step.cycles);
    ASSERT_LE(end, report.residuals.size());
    if (step.cycles > 0)
    {
      EXPECT_EQ(step.residual, report.residuals[end - 1]) << step.name;
    }
  }
  EXPECT_EQ(end, report.residuals.size());
  EXPECT_EQ(static_cast<std::size_t>(report.cycles), end);
  EXPECT_EQ(report.converged, report.steps[0].converged && report.steps[1].converged);
}

} // namespace

TEST(DeformationReport, KCyclesAStepTakeTwoKPlusOnePasses)
{
  for (const StreamMesh& mesh : deformationMeshes())
  {
    ArrayHandles handles = figureHandles(mesh);
    for (const int cycles : { 1, 2, 5 })
    {
      for (const bool core : { false, true })
      {
        DeformOptions options = withCycles(cycles);
        options.inCore = core;
        options.coreNodes = 500;
        const Report report = deformMesh(mesh, handles, options).report;
        EXPECT_EQ(report.passes, 2 * cycles + 1);
        EXPECT_EQ(std::ssize(report.by_pass), report.passes);
        expectStepsToAgree(report);
        EXPECT_EQ(report.steps[0].cycles, cycles);
        EXPECT_EQ(report.steps[1].cycles, cycles);
      }
    }
  }
}

TEST(DeformationReport, AToleranceDoesNotEndAFixedNumberOfCycles)
{
  const StreamMesh mesh = toStream(torus(40, 20, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(4);
  options.tolerance = 0.5;
  const Report report = deformMesh(mesh, handles, options).report;
  EXPECT_EQ(report.passes, 9);
  EXPECT_EQ(report.cycles, 8);
}

TEST(DeformationReport, ByToleranceBothStepsConverge)
{
  for (const StreamMesh& mesh : deformationMeshes())
  {
    ArrayHandles handles = figureHandles(mesh);
    for (const double tolerance : { 1e-3, 1e-6, 1e-10 })
    {
      const Report report = deformMesh(mesh, handles, byTolerance(tolerance)).report;
      EXPECT_TRUE(report.converged);
      expectStepsToAgree(report);
      for (const Report::Step& step : report.steps)
      {
        EXPECT_TRUE(step.converged) << step.name;
        EXPECT_LE(step.residual, tolerance) << step.name;
        EXPECT_GT(step.cycles, 0) << step.name;
      }
      EXPECT_LE(report.passes, report.cycles + 2);
    }
  }
}

TEST(DeformationReport, AToleranceThatIsNotReachedIsSaid)
{
  const StreamMesh mesh = toStream(torus(80, 40, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = byTolerance(1e-10);
  options.maxCycles = 2;
  const Report report = deformMesh(mesh, handles, options).report;
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(hasNote(report, "not converged"));
  expectStepsToAgree(report);
  for (const Report::Step& step : report.steps)
  {
    EXPECT_FALSE(step.converged);
    EXPECT_EQ(step.cycles, 2);
  }
}

TEST(DeformationReport, TheResidualsFallFromCycleToCycle)
{
  const StreamMesh mesh = toStream(torus(150, 80, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  const Report report = deformMesh(mesh, handles, withCycles(6)).report;
  ASSERT_EQ(report.residuals.size(), 12u);
  for (const std::size_t step : { 0, 6 })
  {
    EXPECT_LT(report.residuals[step], 0.5);
    for (std::size_t k = step + 1; k < step + 6; ++k)
    {
      EXPECT_LT(report.residuals[k], 0.5 * report.residuals[k - 1]);
    }
  }
}

TEST(DeformationReport, CountsHeldAndSharedVertices)
{
  const StreamMesh mesh = toStream(torus(60, 30));
  ArrayHandles handles(mesh.vertices());
  const auto below = [](double x) { return [=](const Eigen::Vector3d& p) { return p.x() < x; }; };
  handles.hold(mesh, below(0.0));
  const std::int64_t first = handles.held();
  handles.hold(mesh, below(-1.0), turn(10, { 0, 0, 1 }));
  handles.hold(mesh, below(-2.0), turn(20, { 0, 0, 1 }));
  EXPECT_EQ(handles.held(), first);
  std::int64_t shared = 0;
  for (const std::uint8_t count : handles.Values.mask)
  {
    shared += count > 1;
  }
  ASSERT_GT(shared, 0);
  const Solved solved = deformMesh(mesh, handles, withCycles(2));
  EXPECT_EQ(solved.report.prescribed, first);
  EXPECT_EQ(solved.report.shared, shared);
  EXPECT_EQ(solved.report.vertices, mesh.vertices());
  EXPECT_EQ(solved.report.cells, mesh.cells());
  EXPECT_EQ(solved.report.components, 1);
  EXPECT_EQ(solved.report.free_components, 0);

  // The last handle counts.
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    if (mesh.positions[3 * v] < -2.0)
    {
      const Eigen::Vector3d point = Eigen::Vector3d::Map(&mesh.positions[3 * v]);
      const Eigen::Vector3d target = turn(20, { 0, 0, 1 }).apply(point);
      EXPECT_EQ(solved.values.row(v), target.transpose());
    }
  }
}

TEST(DeformationReport, RaisesWeightsByDefaultWithoutANote)
{
  const StreamMesh mesh = toStream(tetBox(9, 9, 9, 0.2));
  ArrayHandles handles = endHandles(mesh, {}, anyMotion());
  const Report report = deformMesh(mesh, handles, byTolerance(1e-3)).report;
  EXPECT_GT(report.clamped_weights, 0);
  EXPECT_EQ(report.notes, std::vector<std::string>{});
}

TEST(DeformationReport, HasTheStepsInJson)
{
  const StreamMesh mesh = toStream(torus(40, 20));
  ArrayHandles handles = figureHandles(mesh);
  const std::string json = deformMesh(mesh, handles, withCycles(2)).report.json();
  for (const char* part : { "\"steps\"", "\"rotation\"", "\"position\"", "\"shared\"" })
  {
    EXPECT_NE(json.find(part), std::string::npos) << part;
  }
}

TEST(DeformationReport, MemoryDoesNotGrowWithTheNumberOfCycles)
{
  const StreamMesh mesh = toStream(torus(316, 158, 0.3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(2);
  options.coreNodes = 1000;
  const Report few = deformMesh(mesh, handles, options).report;
  options.cycles = 6;
  const Report many = deformMesh(mesh, handles, options).report;
  EXPECT_LE(static_cast<double>(many.pool_bytes_peak), 1.02 * few.pool_bytes_peak);
}

} // namespace smg::testing
