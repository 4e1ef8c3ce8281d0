// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Preview.h"

#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"

#include <algorithm>
#include <vector>

namespace smg::testing
{
namespace
{

class PreviewStreams : public ::testing::Test
{
protected:
  /** A file of the mesh, and the stream of its preview. */
  StreamMesh previewOf(const StreamMesh& mesh, std::int64_t points)
  {
    MemorySource source(mesh, 100);
    writeVsm(source, this->Folder / "mesh.vsm");
    VsmReader reader(this->Folder / "mesh.vsm");
    PreviewSource preview(reader, points);
    // The writer refuses a stream that is not compact.
    writeVsm(preview, this->Folder / "preview.vsm");
    return collect(*VsmReader(this->Folder / "preview.vsm").source());
  }

  TemporaryFolder Folder;
};

std::vector<std::int64_t> numbers(const StreamMesh& mesh, const char* name)
{
  const auto found = std::find_if(mesh.vertexColumns.begin(), mesh.vertexColumns.end(),
    [name](const Column& column) {
      return column.spec == ColumnSpec{ name, ScalarType::Int64, 1 };
    });
  if (found == mesh.vertexColumns.end())
  {
    return {};
  }
  const auto values = found->as<std::int64_t>();
  return { values.begin(), values.end() };
}

} // namespace

TEST_F(PreviewStreams, SayWhichVertexEachPointIs)
{
  StreamMesh mesh = toStream(torus(60, 30));
  const StreamMesh plain = this->previewOf(mesh, 400);
  std::vector<std::int64_t> thousands;
  for (std::int64_t i = 0; i < mesh.vertices(); ++i)
  {
    thousands.push_back(1000 * i);
  }
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>(OriginalIdName, thousands));
  const StreamMesh named = this->previewOf(mesh, 400);

  const std::vector<std::int64_t> ids = numbers(plain, StreamIndexName);
  ASSERT_EQ(std::int64_t(ids.size()), plain.vertices());
  EXPECT_LE(ids.size(), 400U);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(plain.positions[3 * i + axis], mesh.positions[3 * std::size_t(ids[i]) + axis]);
    }
    thousands[i] = 1000 * ids[i];
  }
  thousands.resize(ids.size());
  EXPECT_EQ(numbers(plain, OriginalIdName), ids);
  EXPECT_EQ(numbers(named, StreamIndexName), ids);
  EXPECT_EQ(numbers(named, OriginalIdName), thousands);
  EXPECT_EQ(named.corners, plain.corners);
  EXPECT_TRUE(plain.cellColumns.empty());
}

TEST_F(PreviewStreams, OfTetrahedraAreTheirSurface)
{
  const StreamMesh preview = this->previewOf(toStream(tetBox(5, 5, 5)), 100000);
  EXPECT_EQ(preview.cellType, CellType::Triangle);
  EXPECT_EQ(preview.vertices(), 125 - 27);
  EXPECT_EQ(preview.cells(), 6 * 2 * 16);
}

TEST_F(PreviewStreams, OfFewerOrMorePointsThanAllowedAreRefused)
{
  const StreamMesh mesh = toStream(grid(3, 3));
  for (const std::int64_t points : { std::int64_t(-1), MinPreviewPoints - 1, MaxPreviewPoints + 1 })
  {
    expectError([&] { this->previewOf(mesh, points); }, "expected 8 to 1000000");
  }
}

TEST_F(PreviewStreams, OfCellsWithoutAreaAreRefused)
{
  StreamMesh mesh = toStream(grid(3, 3));
  mesh.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName,
    std::vector<std::uint8_t>(static_cast<std::size_t>(mesh.cells()), DuplicateCell)) };
  expectError([&] { this->previewOf(mesh, 100); }, "mesh.vsm: a preview of at most 100 points");
  VsmReader reader(this->Folder / "mesh.vsm");
  expectError(
    [&] { PreviewSource(reader, 100, {}, "scan.ply"); }, "scan.ply: a preview of at most");
}

} // namespace smg::testing
