// SPDX-License-Identifier: BSD-3-Clause
// The deformation of the armadillo, of triangles and of tetrahedra: feet fixed, top turned by 70
// degrees and scaled by 1.3, an arm turned by 90 degrees.

#include "Solver/Jobs/Deformation/InteractiveDeformation.h"
#include "Testing/Archive/ArchiveMeshes.h"
#include "Testing/Support/ArrayHandles.h"
#include "Testing/Support/Bumps.h"
#include "Testing/Support/DeformMesh.h"
#include "Testing/Support/DirectDeformation.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace smg::testing
{
namespace
{

Eigen::MatrixXd deformed(const StreamMesh& mesh, Handles& handles, const DeformOptions& options)
{
  const Solved solved = deformMesh(mesh, handles, options, 5000);
  EXPECT_EQ(solved.report.passes, 2 * options.cycles + 1);
  EXPECT_LE(solved.report.pool_bytes_peak, options.memoryLimit);
  return solved.values;
}

/** Writes the number to the test's report. */
void record(const std::string& name, double value)
{
  std::ostringstream text;
  text << value;
  ::testing::Test::RecordProperty(name, text.str());
}

/** A number of V-cycles per step, and the allowed error after them. */
struct Figure
{
  int cycles;
  double error;
};

void checkFigures(const StreamMesh& mesh, Weights weights, const std::vector<Figure>& figures)
{
  ArrayHandles handles = figureHandles(mesh);
  const Eigen::MatrixXd direct = deformDirectly(mesh, handles, weights).positions;
  for (const auto& [cycles, allowed] : figures)
  {
    const double error =
      deformationError(mesh, deformed(mesh, handles, withCycles(cycles, weights)), direct);
    EXPECT_LE(error, allowed) << cycles << " cycles";
    record("error after " + std::to_string(cycles) + " cycles", error);
  }
}

class DeformationData
  : public NeedsArchive<::testing::TestWithParam<std::tuple<const char*, Weights>>>
{
};

TEST_P(DeformationData, AgreesWithTheDirectOne)
{
  const auto [name, weights] = this->GetParam();
  checkFigures(archiveMesh(name), weights, { { 3, 2e-3 }, { 6, 1e-5 }, { 9, 1e-7 } });
}

TEST_P(DeformationData, StreamingAndInteractiveEqualInCore)
{
  const auto [name, weights] = this->GetParam();
  const StreamMesh mesh = archiveMesh(name);
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(2, weights);
  options.inCore = true;
  const Eigen::MatrixXd inCore = deformed(mesh, handles, options);
  options.inCore = false;
  for (const std::int64_t block : { 500, 4096 })
  {
    for (const int threads : { 1, 2 })
    {
      options.blockNodes = block;
      options.coreNodes = block;
      options.threads = threads;
      EXPECT_TRUE(sameBits(deformed(mesh, handles, options), inCore));
    }
  }
  MemorySource source(mesh);
  ArrayHandles before = figureHandles(mesh, 20.0);
  InteractiveDeformation interactive(source, before, options);
  ASSERT_TRUE(interactive.update(handles.Values));
  EXPECT_TRUE(sameBits(valuesOf(interactive), inCore));
}

/** "Uniform", "Cotangent". */
std::string nameOf(Weights weights)
{
  return weights == Weights::Uniform ? "Uniform" : "Cotangent";
}

INSTANTIATE_TEST_SUITE_P(Armadillo, DeformationData,
  ::testing::Combine(
    ::testing::Values("armadillo43k.obj", "armadillo_tet.msh"), ::testing::ValuesIn(BothWeights)),
  [](const auto& test)
  {
    const bool solid = std::string(std::get<0>(test.param)) == "armadillo_tet.msh";
    return (solid ? "Solid" : "Surface") + nameOf(std::get<1>(test.param));
  });

class RefinedDeformationData : public NeedsArchive<::testing::TestWithParam<Weights>>
{
};
class RefinedDeformationLong : public RefinedDeformationData
{
};

TEST_P(RefinedDeformationData, AgreesWithTheDirectOne)
{
  checkFigures(toStream(refinedArmadillo(1)), this->GetParam(), { { 9, 1e-5 } });
}

TEST_P(RefinedDeformationLong, AgreesWithTheDirectOne)
{
  checkFigures(toStream(refinedArmadillo(2)), this->GetParam(), { { 9, 1e-5 } });
}

TEST_P(RefinedDeformationLong, StaysWithin128MiB)
{
  const StreamMesh mesh = toStream(refinedArmadillo(3));
  ArrayHandles handles = figureHandles(mesh);
  DeformOptions options = withCycles(3, this->GetParam());
  options.memoryLimit = std::int64_t(128) << 20;
  deformed(mesh, handles, options);
}

TEST_P(RefinedDeformationData, KeepsDetails)
{
  const StreamMesh mesh = toStream(bumpy(refined(bumpy(refinedArmadillo(0), 0.3, 1)), 0.3, 2));
  ArrayHandles handles = figureHandles(mesh);
  const DirectDeformation direct = deformDirectly(mesh, handles, this->GetParam());
  const Eigen::MatrixXd result = deformed(mesh, handles, withCycles(6, this->GetParam()));
  const std::vector<double> angles =
    detailAngles(mesh, handles.Values, direct, result, this->GetParam());
  const double median = angles[angles.size() / 2];
  record("median angle in degrees", median);
  EXPECT_LT(median, 5.0);
}

INSTANTIATE_TEST_SUITE_P(Armadillo, RefinedDeformationData, ::testing::ValuesIn(BothWeights),
  [](const auto& test) { return nameOf(test.param); });
INSTANTIATE_TEST_SUITE_P(Armadillo, RefinedDeformationLong, ::testing::ValuesIn(BothWeights),
  [](const auto& test) { return nameOf(test.param); });

} // namespace
} // namespace smg::testing
