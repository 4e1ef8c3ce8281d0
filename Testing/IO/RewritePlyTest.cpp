// SPDX-License-Identifier: BSD-3-Clause
#include "smg/WriteMesh.h"

#include "IO/Results/VertexNormals.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/IO/ShiftedSource.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TestFolders.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace smg::testing
{
namespace
{

/** A square of a polygon and a triangle, with many other elements. */
const std::string SquarePly =
  "ply\r\nformat ascii 1.0\r\ncomment  a square\r\n"
  "element camera 1\nproperty float view\nproperty list int short lens\n"
  "obj_info two\n"
  "element vertex 7\nproperty float x\nproperty double y\nproperty int z\n"
  "property float nx\nproperty float ny\nproperty float nz\n"
  "property uchar red\n"
  "element face 2\nproperty float nx\n"
  "property list uchar uint vertex_index\nproperty short group\n"
  "end_header\n"
  "0.5 2 -7 8\n"
  "9 9 9 1 0 0 1\n"
  "1 1 0 0 0 1 2\n"
  "0 0 0 0 0 1 3\n"
  "1 0 0 0 0 1 4\n"
  "8 8 8 0 1 0 5\n"
  "0 1 0 0 0 1 6\n"
  "0.5 2 0 0 0 1 255\n"
  "0.25 4 2 3 1 5 -3\n"
  "0.75 3 1 5 6 12\n";

class RewritePly : public ::testing::Test
{
protected:
  /** The mesh stream made from the file. */
  std::unique_ptr<MeshSource> streamOf(const std::filesystem::path& in)
  {
    convert(in, this->Folder / "mesh.vsm");
    return VsmReader(this->Folder / "mesh.vsm").source();
  }

  /** The same, moved along x, with normals along y, or none. */
  std::unique_ptr<MeshSource> moved(
    const std::filesystem::path& in, double shift, bool normals = true)
  {
    convert(in, this->Folder / "mesh.vsm");
    auto source = std::make_unique<ShiftedSource>(
      VsmReader(this->Folder / "mesh.vsm").source({ "OriginalId" }, {}), shift);
    if (!normals)
    {
      return source;
    }
    return std::make_unique<AddedColumn>(std::move(source), AddedColumn::Vertices,
      ColumnSpec{ NormalsName, ScalarType::Float32, 3 },
      [](const MeshBlock&, Column& column)
      {
        const std::span<float> values = column.as<float>();
        for (std::size_t i = 0; i < values.size(); i++)
        {
          values[i] = i % 3 == 1 ? 1.0F : 0.0F;
        }
      });
  }

  std::filesystem::path squareFile()
  {
    std::ofstream(this->Folder / "in.ply", std::ios::binary) << SquarePly;
    return this->Folder / "in.ply";
  }

  std::string header()
  {
    const std::string text = readFile(this->Folder / "out.ply");
    return text.substr(0, text.find("end_header"));
  }

  TemporaryFolder Folder;
};

TEST_F(RewritePly, KeepsEverythingButTheCoordinates)
{
  const std::filesystem::path in = this->squareFile();
  const ReadMesh before = importWhole(in);
  rewriteMesh(in, this->Folder / "out.ply", *this->moved(in, 0.125));
  const ReadMesh after = importWhole(this->Folder / "out.ply");
  EXPECT_EQ(this->header(),
    "ply\nformat binary_little_endian 1.0\ncomment  a square\n"
    "element camera 1\nproperty float view\nproperty list int short lens\n"
    "obj_info two\n"
    "element vertex 7\nproperty float x\nproperty double y\nproperty double z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
    "element face 2\n"
    "property list uchar uint vertex_index\nproperty short group\n");
  std::vector<double> expected = before.positions;
  for (const std::size_t v : { 1, 2, 3, 5, 6 })
  {
    expected[3 * v] += 0.125;
  }
  EXPECT_EQ(after.positions, expected);
  EXPECT_EQ(after.corners, before.corners);
  EXPECT_EQ(after.elements, before.elements);
  ASSERT_EQ(after.vertexColumns.size(), 2u);
  EXPECT_EQ(after.vertexColumns[0].value(0, 0), 1);
  EXPECT_EQ(after.vertexColumns[0].value(4, 1), 1);
  EXPECT_EQ(after.vertexColumns[0].value(6, 1), 1);
  EXPECT_EQ(after.vertexColumns[0].value(6, 2), 0);
  EXPECT_EQ(after.vertexColumns[1].bytes, before.vertexColumns[1].bytes);
  ASSERT_EQ(after.elementColumns.size(), 1u);
  EXPECT_EQ(after.elementColumns[0].bytes, before.elementColumns.back().bytes);
}

TEST_F(RewritePly, WritesIntegerNormalsAsReal)
{
  std::string text = SquarePly;
  for (const std::string axis : { "nx", "ny", "nz" })
  {
    const std::string line = "property float " + axis;
    text.replace(text.find(line), line.size(), "property char " + axis);
  }
  std::ofstream(this->Folder / "in.ply", std::ios::binary) << text;
  rewriteMesh(this->Folder / "in.ply", this->Folder / "out.ply",
    *this->moved(this->Folder / "in.ply", 0.125));
  EXPECT_NE(this->header().find("property float ny\n"), std::string::npos);
  EXPECT_EQ(this->header().find("property char"), std::string::npos);
  const ReadMesh after = importWhole(this->Folder / "out.ply");
  EXPECT_EQ(after.vertexColumns[0].value(0, 0), 1);
  EXPECT_EQ(after.vertexColumns[0].value(6, 1), 1);
}

TEST_F(RewritePly, LeavesStaleNormalsOut)
{
  const std::filesystem::path in = this->squareFile();
  rewriteMesh(in, this->Folder / "out.ply", *this->moved(in, 0.125, false));
  EXPECT_EQ(this->header().find("property float n"), std::string::npos);
  EXPECT_EQ(importWhole(this->Folder / "out.ply").vertexColumns.size(), 1u);
}

TEST_F(RewritePly, GivesABinaryFileBackByteForByte)
{
  StreamMesh mesh = toStream(shuffled(torus(70, 50, 0.2)), TestOrder::Keep);
  mesh.vertexColumns.push_back(
    randomColumn({ "Colors", ScalarType::UInt8, 3 }, mesh.vertices(), 3));
  for (const bool single : { false, true })
  {
    write(this->Folder / "keep.vsm", single ? testStream(torus(9, 9), true) : mesh,
      { .single = single });
    writeMesh(*VsmReader(this->Folder / "keep.vsm").source(), this->Folder / "in.ply");
    // The order of the stream differs from that of the file.
    rewriteMesh(
      this->Folder / "in.ply", this->Folder / "out.ply", *this->streamOf(this->Folder / "in.ply"));
    EXPECT_TRUE(readFile(this->Folder / "in.ply") == readFile(this->Folder / "out.ply"));
  }
}

TEST_F(RewritePly, RefusesAnotherMeshAndLeavesNothing)
{
  const std::filesystem::path in = this->squareFile();
  write(this->Folder / "keep.vsm", toStream(torus(9, 9)));
  writeMesh(*VsmReader(this->Folder / "keep.vsm").source(), this->Folder / "torus.ply");
  const std::unique_ptr<MeshSource> other = this->streamOf(this->Folder / "torus.ply");
  expectError([&] { rewriteMesh(in, this->Folder / "out.ply", *other); }, "only 7 vertices");
  const std::unique_ptr<MeshSource> far = this->moved(in, 1e39);
  expectError([&] { rewriteMesh(in, this->Folder / "out.ply", *far); }, "single precision");

  const std::unique_ptr<MeshSource> good = this->moved(in, 0);
  std::ofstream(in, std::ios::binary) << SquarePly.substr(0, SquarePly.size() - 9);
  expectError([&] { rewriteMesh(in, this->Folder / "out.ply", *good); },
    "line 30: 3 cannot be the length of a list");
  EXPECT_FALSE(std::filesystem::exists(this->Folder / "out.ply"));
  EXPECT_EQ(this->Folder.entries(), 4);
}

TEST_F(RewritePly, KeepsTheOrderOfTheScansOfTheArchive)
{
  const std::filesystem::path data = archiveFolder();
  if (data.empty() || !std::filesystem::exists(data / "bunny.ply"))
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR names no folder with the scans";
  }
  for (const char* name : { "bunny.ply", "horse_be.ply", "rangemap_lato315.ply" })
  {
    rewriteMesh(data / name, this->Folder / "out.ply", *this->moved(data / name, 0.0));
    const ReadMesh before = importWhole(data / name);
    const ReadMesh after = importWhole(this->Folder / "out.ply");
    EXPECT_TRUE(before.positions == after.positions) << name;
    EXPECT_TRUE(before.corners == after.corners) << name;
    expectSame(before.vertexColumns, after.vertexColumns);
  }
}

} // namespace
} // namespace smg::testing
