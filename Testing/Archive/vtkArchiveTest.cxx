// SPDX-License-Identifier: BSD-3-Clause
// The solver on real meshes: the same bits in core and out of core, the rate of convergence, and
// the solution of a direct solver.

#include "Testing/Archive/ArchiveMeshes.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/SolveMesh.h"

#include <gtest/gtest.h>

namespace smg::testing
{
namespace
{

Solved solved(MemorySource& source, ArrayProblem& problem, const SolveOptions& options)
{
  source.rewind(5000);
  return solveMesh(source, problem, options);
}

int cyclesTo(const Report& report, double residual)
{
  for (std::size_t k = 0; k < report.residuals.size(); ++k)
  {
    if (report.residuals[k] <= residual)
    {
      return static_cast<int>(k) + 1;
    }
  }
  return static_cast<int>(report.residuals.size()) + 1000;
}

/** At most this many V-cycles to a relative residual of 1e-6. */
int allowedCycles(CellType type, Weights weights)
{
  return type == CellType::Tetrahedron ? 14 : weights == Weights::Uniform ? 8 : 11;
}

void checkConvergenceAndAccuracy(const StreamMesh& mesh, Weights weights)
{
  MemorySource source(mesh);
  ArrayProblem problem = fixedEnds(mesh);
  problem.EdgeWeights = weights;
  SolveOptions options;
  options.tolerance = 1e-10;
  const Solved streamed = solved(source, problem, options);
  EXPECT_TRUE(streamed.report.converged);
  EXPECT_EQ(streamed.report.passes, streamed.report.cycles + 1);
  EXPECT_LE(cyclesTo(streamed.report, 1e-6), allowedCycles(mesh.cellType, weights));
  EXPECT_LE(streamed.report.cycles, 20);

  source.rewind(5000);
  const Eigen::MatrixXd direct = solveDirect(assembleDirect(source, problem));
  EXPECT_LT(relativeError(streamed.values, direct), 1e-7);
}

void checkBits(const StreamMesh& mesh)
{
  MemorySource source(mesh);
  ArrayProblem problem = fixedEnds(mesh);
  SolveOptions options;
  options.inCore = true;
  const Solved inCore = solved(source, problem, options);
  options.inCore = false;
  for (const std::int64_t block : { 500, 4096 })
  {
    for (const int threads : { 1, 2 })
    {
      options.blockNodes = block;
      options.threads = threads;
      options.coreNodes = block;
      EXPECT_TRUE(sameBits(solved(source, problem, options).values, inCore.values));
    }
  }
}

using ArchiveMesh = NeedsArchive<::testing::TestWithParam<const char*>>;
class ArchiveData : public ArchiveMesh
{
};
class ArchiveLong : public ArchiveMesh
{
};

TEST_P(ArchiveData, StreamingEqualsInCore)
{
  checkBits(archiveMesh(this->GetParam()));
}

TEST_P(ArchiveData, AgreesWithTheDirectSolve)
{
  const StreamMesh mesh = archiveMesh(this->GetParam());
  checkConvergenceAndAccuracy(mesh, Weights::Clamped);
  checkConvergenceAndAccuracy(mesh, Weights::Uniform);
}

TEST_P(ArchiveLong, AgreesWithTheDirectSolve)
{
  checkConvergenceAndAccuracy(archiveMesh(this->GetParam()), Weights::Clamped);
}

/** The file's name without characters that a test name must not have. */
std::string nameOfFile(const ::testing::TestParamInfo<const char*>& test)
{
  std::string name = test.param;
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Small, ArchiveData,
  ::testing::Values("armadillo43k.obj", "lucy50k.ply", "dragon_res3.ply", "rangemap_lato315.ply",
    "armadillo_tet.msh", "bunny_tet.mesh", "raptor_tet.vtu"),
  nameOfFile);

INSTANTIATE_TEST_SUITE_P(Large, ArchiveLong,
  ::testing::Values("bunny.ply", "elephant44k.off", "horse_be.ply", "brain168k.vtk", "dragon.ply",
    "head_tet336k.vtk"),
  nameOfFile);

/** Convergence and memory at each refinement from `first` to `last`. */
void checkRefinements(int first, int last)
{
  std::int64_t peakBefore = 0;
  for (int level = first; level <= last; ++level)
  {
    const StreamMesh mesh = toStream(refinedArmadillo(level));
    MemorySource source(mesh);
    for (const Weights weights : { Weights::Uniform, Weights::Clamped })
    {
      ArrayProblem problem = fixedEnds(mesh);
      problem.EdgeWeights = weights;
      SolveOptions options;
      options.tolerance = 1e-10;
      const Solved result = solved(source, problem, options);
      EXPECT_LE(cyclesTo(result.report, 1e-6), allowedCycles(CellType::Triangle, weights));
      EXPECT_LE(result.report.cycles, 20);
      EXPECT_LE(result.report.pool_bytes_peak, std::int64_t(64) << 20);
      if (weights == Weights::Clamped)
      {
        EXPECT_LE(result.report.peak_nodes, peakBefore > 0 ? 2.2 * peakBefore : 1e9);
        peakBefore = result.report.peak_nodes;
      }
    }
  }
}

class RefinedData : public NeedsArchive<::testing::Test>
{
};
class RefinedLong : public NeedsArchive<::testing::Test>
{
};

TEST_F(RefinedData, ConvergenceAndMemory)
{
  checkRefinements(1, 2);
}

TEST_F(RefinedLong, ConvergenceAndMemory)
{
  checkRefinements(2, 3);
}

} // namespace
} // namespace smg::testing
