// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/MeshText.h"
#include "Testing/Support/InCoreOrder.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/Refinement.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestFolders.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

namespace smg::testing
{
namespace
{

const std::filesystem::path Archive = archiveFolder();

/** A mesh of the archive, and the allowed ratios of its order to a breadth-first order in core. */
struct Bound
{
  std::string file;
  int refinements = 0;
  double span = 1.05;
  double window = 1.05;
};

/** Span (in thousandths) and mean window of a stream over those of a breadth-first order in core.
 */
OrderSize ratios(const IndexedTestMesh& mesh, const StreamMesh& stream)
{
  const Neighbours neighbours = neighboursOf(mesh);
  const OrderSize inCore = orderSize(neighbours, inCoreBreadthFirst(neighbours));
  const Neighbours streamed =
    neighboursOf(IndexedTestMesh{ stream.cellType, stream.positions, stream.corners });
  std::vector<std::uint32_t> order(streamed.vertices());
  std::iota(order.begin(), order.end(), 0u);
  const OrderSize out = orderSize(streamed, order);
  return { 1000 * out.span / inCore.span, out.meanWindow / inCore.meanWindow };
}

class OrderQuality : public ::testing::TestWithParam<Bound>
{
};

} // namespace

TEST_P(OrderQuality, IsNoWorseThanInCore)
{
  if (Archive.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  const Bound& bound = GetParam();
  const ReadMesh read = importWhole(Archive / bound.file);
  IndexedTestMesh mesh{ read.cellType, read.positions, read.corners };
  for (int i = 0; i < bound.refinements; ++i)
  {
    mesh = refined(mesh);
  }
  const TemporaryFolder folder;
  const std::filesystem::path in =
    folder.path() / (mesh.cellType == CellType::Triangle ? "in.off" : "in.mesh");
  writeBytes(in, meshText(shuffled(mesh)));
  convert(in, folder / "out.vsm");
  const OrderSize ratio = ratios(mesh, collect(*VsmReader(folder / "out.vsm").source()));
  EXPECT_LE(static_cast<double>(ratio.span), 1000 * bound.span);
  EXPECT_LE(ratio.meanWindow, bound.window);
}

INSTANTIATE_TEST_SUITE_P(Data, OrderQuality,
  ::testing::Values(Bound{ "bunny.ply" }, Bound{ "elephant44k.off" }, Bound{ "brain168k.vtk" },
    Bound{ "head_tet336k.vtk" }, Bound{ "armadillo43k.obj", 1, 0.8, 0.8 },
    Bound{ "dragon.ply", 0, 0.8, 0.88 }),
  [](const auto& parameters)
  {
    std::string name = parameters.param.file + std::to_string(parameters.param.refinements);
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return name;
  });

} // namespace smg::testing
