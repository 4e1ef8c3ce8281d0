// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/GroupedGmsh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/DescribedProblem.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** A long body whose ends are one, with a jump of 2. */
ProblemDescription ring()
{
  ProblemDescription problem;
  problem.periodic = { { InGroup{ { "7" } }, InGroup{ { "8" } }, { 2.0 } } };
  return problem;
}

/** The largest distance of two vertices of a stream that the problem couples. */
std::int64_t reachIn(const std::filesystem::path& file)
{
  const VsmReader reader(file);
  DescribedProblem problem(ring(), reader.info());
  problem.prepare(*reader.source(problem.vertexColumns(), problem.cellColumns()));
  std::int64_t reach = 0;
  for (const VertexCouplings::Tie& tie : problem.couplings()->ties)
  {
    reach = std::max(reach, tie.vertex - tie.to);
  }
  return reach;
}

/** The solution by positions. */
std::map<std::vector<double>, double> solutionOf(const std::filesystem::path& file)
{
  const VsmReader reader(file);
  SolveOptions options;
  options.tolerance = 1e-12;
  const auto solution = solve(reader, ring(), options);
  const auto source = reader.source({}, {});
  std::map<std::vector<double>, double> found;
  for (MeshBlock block; source->next(block);)
  {
    std::vector<double> values(static_cast<std::size_t>(block.vertices()));
    solution->read(block.firstVertex, block.vertices(), values);
    for (std::size_t v = 0; v < values.size(); ++v)
    {
      found[{ block.positions.begin() + static_cast<std::ptrdiff_t>(3 * v),
        block.positions.begin() + static_cast<std::ptrdiff_t>(3 * v + 3) }] = values[v];
    }
  }
  return found;
}

} // namespace

/** An order for a problem keeps coupled vertices within a few sections of each other, also if the
 * mesh was a stream before, and the solution is the same. */
TEST(CouplingOrder, KeepsCoupledVerticesNear)
{
  constexpr int Length = 40, Section = 16;
  const TemporaryFolder folder;
  writeBytes(folder / "bar.msh",
    gmshText(shuffled(tetBox(Length, 4, 4)), 0, { { 7, 0.0 }, { 8, Length - 1.0 } }));
  convert(folder / "bar.msh", folder / "unaware.vsm");
  ConversionOptions aware;
  aware.coupled = coupledGroups(ring());
  convert(folder / "bar.msh", folder / "aware.vsm", aware);
  convert(folder / "unaware.vsm", folder / "again.vsm", aware);
  EXPECT_GT(reachIn(folder / "unaware.vsm"), 10 * Section);
  const auto expected = solutionOf(folder / "unaware.vsm");
  for (const char* name : { "aware.vsm", "again.vsm" })
  {
    EXPECT_LT(reachIn(folder / name), 4 * Section) << name;
    const auto found = solutionOf(folder / name);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [point, value] : found)
    {
      EXPECT_NEAR(value, 2.0 * point[0] / (Length - 1.0) - 1.0, 1e-7);
      EXPECT_NEAR(value, expected.at(point), 1e-7);
    }
  }
}

} // namespace smg::testing
