// SPDX-License-Identifier: BSD-3-Clause
// The solver on real meshes: the same bits in core and out of core, the rate of convergence, and
// the answer of a direct solve.

#include "IO/Conversion/OpenMesh.h"
#include "IO/vtkMeshImport.h"
#include "Solver/Solve.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/Refinement.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

const std::filesystem::path Archive = SMG_TEST_DATA_DIR;

/** The mesh in breadth-first order. */
StreamMesh archiveMesh(const std::string& name)
{
  registerVtkImporter();
  const TemporaryFolder scratch;
  ConversionOptions options;
  options.scratch = scratch.path();
  const std::unique_ptr<OpenedMesh> opened = openMesh(Archive / name, options);
  const std::unique_ptr<MeshSource> source = opened->reader().source();
  return collect(*source);
}

struct Solved
{
  std::vector<double> values;
  Report report;
};

Solved solved(MemorySource& source, ArrayProblem& problem, const SolveOptions& options)
{
  source.rewind(5000);
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  Solved result;
  result.report = solution->report();
  result.values.resize(static_cast<std::size_t>(solution->vertices() * solution->columns()));
  solution->read(0, solution->vertices(), result.values);
  return result;
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
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd values =
    Eigen::Map<const RowMajor>(streamed.values.data(), mesh.vertices(), problem.Columns);
  EXPECT_LT(relativeError(values, direct), 1e-7);
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
      EXPECT_EQ(solved(source, problem, options).values, inCore.values);
    }
  }
}

/** A test that is skipped without the archive. */
template <class Base>
class NeedsArchive : public Base
{
protected:
  void SetUp() override
  {
    if (Archive.empty())
    {
      GTEST_SKIP() << "SMG_TEST_DATA_DIR is empty";
    }
  }
};

using ArchiveMesh = NeedsArchive<::testing::TestWithParam<const char*>>;
class ArchiveData : public ArchiveMesh
{
};
class ArchiveLong : public ArchiveMesh
{
};

TEST_P(ArchiveData, streamingEqualsInCore)
{
  checkBits(archiveMesh(this->GetParam()));
}

TEST_P(ArchiveData, agreesWithTheDirectSolve)
{
  const StreamMesh mesh = archiveMesh(this->GetParam());
  checkConvergenceAndAccuracy(mesh, Weights::Cotangent);
  checkConvergenceAndAccuracy(mesh, Weights::Uniform);
}

TEST_P(ArchiveLong, agreesWithTheDirectSolve)
{
  checkConvergenceAndAccuracy(archiveMesh(this->GetParam()), Weights::Cotangent);
}

INSTANTIATE_TEST_SUITE_P(Small, ArchiveData,
  ::testing::Values("armadillo43k.obj", "lucy50k.ply", "dragon_res3.ply", "rangemap_lato315.ply",
    "armadillo_tet.msh", "bunny_tet.mesh", "raptor_tet.vtu"));

INSTANTIATE_TEST_SUITE_P(Large, ArchiveLong,
  ::testing::Values("bunny.ply", "elephant44k.off", "horse_be.ply", "brain168k.vtk", "dragon.ply",
    "head_tet336k.vtk"));

/** The armadillo refined `levels` times. */
StreamMesh armadillo(int levels)
{
  const StreamMesh coarse = archiveMesh("armadillo43k.obj");
  IndexedTestMesh mesh{ coarse.cellType, coarse.positions, coarse.corners };
  for (int l = 0; l < levels; ++l)
  {
    mesh = refined(mesh);
  }
  return toStream(mesh);
}

/** Convergence and memory at each refinement from `first` to `last`. */
void checkRefinements(int first, int last)
{
  std::int64_t peakBefore = 0;
  for (int level = first; level <= last; ++level)
  {
    const StreamMesh mesh = armadillo(level);
    MemorySource source(mesh);
    for (const Weights weights : { Weights::Uniform, Weights::Cotangent })
    {
      ArrayProblem problem = fixedEnds(mesh);
      problem.EdgeWeights = weights;
      SolveOptions options;
      options.tolerance = 1e-10;
      const Solved result = solved(source, problem, options);
      EXPECT_LE(cyclesTo(result.report, 1e-6), allowedCycles(CellType::Triangle, weights));
      EXPECT_LE(result.report.cycles, 20);
      EXPECT_LE(result.report.pool_bytes_peak, std::int64_t(64) << 20);
      if (weights == Weights::Cotangent)
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

TEST_F(RefinedData, convergenceAndMemory)
{
  checkRefinements(1, 2);
}

TEST_F(RefinedLong, convergenceAndMemory)
{
  checkRefinements(2, 3);
}

} // namespace
} // namespace smg::testing
