// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/ReportFields.h"

#include <gtest/gtest.h>

#include <cmath>

// What follows from the list of the entries of a report.

namespace smg::testing
{
namespace
{

Report reportOf(int passes, double residual)
{
  Report report;
  report.vertices = 10 * passes;
  report.passes = passes;
  report.residuals = { 1.0, residual };
  report.converged = residual < 1e-6;
  report.pool_bytes_peak = 1000 / passes;
  report.seconds.build = passes;
  report.bytes_by_kind = { { "rows", passes, 1, 2 }, { "state", 0, 3, 4 } };
  report.notes = { "the same", "of " + std::to_string(passes) };
  return report;
}

} // namespace

TEST(Report, IsRestoredWithFiguresThatItsJsonLeavesOut)
{
  Report report = reportOf(3, 1e-9);
  report.shared = 7;     // shown with steps
  report.energy = { 5 }; // shown with means
  report.areas = { true, 2, 1.5, true, { { 4.0, 2, 1.5 } } };
  report.inverted = { 1, 0.5, 9, -0.25, { 1, 2, 3 } };
  report.distance.emplace();
  report.distance->paths = { { 5, -1, HUGE_VAL, { { 1, 2, 3 } } } };
  report.volume = { NAN, 2.0, 0.1 };
  const Report restored = unpackedReport(packedReport(report));
  EXPECT_EQ(restored.json(), report.json());
  EXPECT_EQ(restored.shared, 7);
  EXPECT_EQ(restored.energy, report.energy);
  EXPECT_EQ(restored.inverted->place, report.inverted->place);
  EXPECT_EQ(restored.distance->paths[0].length, HUGE_VAL);
  EXPECT_TRUE(std::isnan(restored.volume->before));
  EXPECT_FALSE(restored.errors);
}

TEST(Report, OfSeveralSolvesIsTheirTotal)
{
  Report total = reportOf(2, 1e-9);
  addFields(total, reportOf(3, 0.5));
  EXPECT_EQ(total.vertices, 30);
  EXPECT_EQ(total.passes, 5);
  EXPECT_EQ(total.residuals, (std::vector{ 1.0, 1e-9, 1.0, 0.5 }));
  EXPECT_FALSE(total.converged);
  EXPECT_EQ(total.pool_bytes_peak, 500);
  EXPECT_EQ(total.seconds.build, 5.0);
  EXPECT_EQ(total.notes, (std::vector<std::string>{ "the same", "of 2", "of 3" }));
  ASSERT_EQ(total.bytes_by_kind.size(), 3U);
  EXPECT_EQ(total.bytes_by_kind[1].read, 6);
  EXPECT_EQ(total.bytes_by_kind[1].written, 8);
}

} // namespace smg::testing
