// SPDX-License-Identifier: BSD-3-Clause
// The public functions on stored meshes do what their parts do, bit for bit.
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/DeformationDescription.h"
#include "smg/DescribedHandles.h"
#include "smg/DescribedProblem.h"
#include "smg/SolvedMesh.h"
#include "smg/WriteMesh.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

std::string bytesOf(const std::filesystem::path& path)
{
  std::ifstream in(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), {} };
}

std::vector<double> valuesOf(Solution& solution)
{
  std::vector<double> values(static_cast<std::size_t>(solution.vertices() * solution.columns()));
  solution.read(0, solution.vertices(), values);
  return values;
}

class FiveStatements : public ::testing::Test
{
protected:
  FiveStatements()
  {
    MemorySource source(toStream(grid(30, 20)));
    writeVsm(source, this->Folder / "grid.vsm");
  }

  TemporaryFolder Folder;
};

} // namespace

/** The tolerance is a share of a residual: it must not be that of an offset of the values. */
TEST_F(FiveStatements, SolveAsWellWithAnOffsetOfTheValues)
{
  const auto mesh = openMesh(this->Folder / "grid.vsm");
  std::vector<double> expected;
  for (const double offset : { 0.0, 293.15, -1000.0, 1e6 })
  {
    ProblemDescription field;
    field.dirichlet = { { halfSpace({ 1, 0, 0 }, 20), offset + 1 },
      { smg::sphere({ 0, 0, 0 }, 3), offset } };
    const std::vector<double> values = valuesOf(*solve(*mesh, field));
    expected = expected.empty() ? values : expected;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      ASSERT_NEAR(values[i] - offset, expected[i], 1e-6) << offset;
    }
  }
}

TEST_F(FiveStatements, WriteTheFileOfTheParts)
{
  ProblemDescription field;
  field.dirichlet = { { halfSpace({ 1, 0, 0 }, 20), 1.0 }, { smg::sphere({ 0, 0, 0 }, 3), 0.0 } };
  field.source = 0.5;
  const auto mesh = openMesh(this->Folder / "grid.vsm");
  const auto solution = solve(*mesh, field, { .memoryLimit = 256 * MiB });
  const Report report =
    write(*mesh, field, *solution, this->Folder / "field.vsm", { .flux = true });

  VsmReader reader(this->Folder / "grid.vsm");
  DescribedProblem problem(field, reader.info());
  const auto source = [&] { return reader.source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source());
  const auto parts = solve(*source(), problem);
  SolvedMesh solved(reader, problem, *parts, { .flux = true });
  writeMesh(solved, this->Folder / "parts.vsm");
  Report expected = parts->report();
  solved.finish(expected);
  EXPECT_TRUE(bytesOf(this->Folder / "field.vsm") == bytesOf(this->Folder / "parts.vsm"));
  EXPECT_EQ(report.energy, expected.energy);
  ASSERT_EQ(report.conditions.size(), 2u);
  EXPECT_EQ(report.conditions[0].flux, expected.conditions[0].flux);
}

TEST_F(FiveStatements, DeformAsTheParts)
{
  DeformationDescription turn;
  turn.handles = { { smg::sphere({ 0, 0, 0 }, 3), HandleMotion() },
    { halfSpace({ 1, 0, 0 }, 25), HandleMotion({ .translation = { 0, 0, 4 } }) } };
  turn.weights = Weights::Cotangent;
  const auto mesh = openMesh(this->Folder / "grid.vsm");
  const std::vector<double> positions = valuesOf(*deform(*mesh, turn));

  DescribedHandles handles(turn, mesh->info());
  const auto source = [&] { return mesh->source(handles.vertexColumns(), handles.cellColumns()); };
  handles.prepare(*source());
  DeformOptions options;
  turn.applyTo(options);
  EXPECT_EQ(positions, valuesOf(*deform(*source(), handles, options)));
}

TEST_F(FiveStatements, ContinueAfterAKillAndStopAtTheTolerance)
{
  ProblemDescription field;
  field.dirichlet = { { halfSpace({ 1, 0, 0 }, 20), 1.0 } };
  field.source = 1.0;
  const auto mesh = openMesh(this->Folder / "grid.vsm");
  SolveOptions options;
  const std::vector<double> expected = valuesOf(*solve(*mesh, field, options));
  options.checkpoint.folder = this->Folder / "checkpoint";
  options.blockNodes = 64;
  int calls = 0;
  options.progress = [&calls](double) { return ++calls < 12; };
  EXPECT_THROW(solve(*mesh, field, options), Cancelled);
  options.progress = {};
  ProblemDescription other = field;
  other.source = 2.0;
  expectError([&] { solve(*mesh, other, options); }, "problem");
  {
    const auto resumed = solve(*mesh, field, options);
    EXPECT_EQ(valuesOf(*resumed), expected);
    write(*mesh, field, *resumed, this->Folder / "field.ply");
  }
  EXPECT_FALSE(std::filesystem::exists(options.checkpoint.folder));

  options = {};
  options.tolerance = SolveOptions::AutomaticTolerance;
  EXPECT_TRUE(solve(*mesh, field, options)->report().errors.has_value());
}

TEST_F(FiveStatements, SayWhatIsMissing)
{
  const auto mesh = openMesh(this->Folder / "grid.vsm");
  expectError([&] { solve(*mesh, {}, {}, "heat.json"); }, "heat.json says nothing to solve for");
  ProblemDescription field;
  field.source = "nowhere";
  expectError([&] { solve(*mesh, field); }, "problem: source: ");
}

} // namespace smg::testing
