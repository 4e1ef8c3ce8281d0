// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Columns.h"

#include "Testing/IO/ContainerMeshes.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

const char* const Reserved[] = { "GlobalIds", "vtkGhostType", "StreamFinalized", "Position",
  "LastCell", "Corners" };

} // namespace

TEST(ReservedNames, AreThoseOfPiecesAndOfTheContainer)
{
  for (const char* name : Reserved)
  {
    EXPECT_TRUE(isReservedColumn(name)) << name;
  }
  EXPECT_TRUE(isContractArray("GlobalIds"));
  EXPECT_FALSE(isContractArray("Position"));
  EXPECT_FALSE(isReservedColumn("OriginalId"));
}

TEST(ReservedNames, AreRefusedByTheWriter)
{
  TemporaryFolder folder;
  for (const bool ofCells : { false, true })
  {
    for (const char* name : Reserved)
    {
      StreamMesh mesh = toStream(grid(3, 3));
      (ofCells ? mesh.cellColumns : mesh.vertexColumns)
        .push_back(randomColumn(
          { name, ScalarType::Int32, 1 }, ofCells ? mesh.cells() : mesh.vertices(), 1));
      expectError([&] { write(folder / "a.vsm", mesh); }, "reserved");
    }
  }
  StreamMesh mesh = toStream(grid(3, 3));
  mesh.cellColumns.push_back(
    randomColumn({ CellFlagsName, ScalarType::Float32, 1 }, mesh.cells(), 1));
  expectError([&] { write(folder / "a.vsm", mesh); }, "one uint8");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ReservedNames, AreLeftOutByTheImport)
{
  TemporaryFolder folder;
  writeBytes(folder / "a.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nproperty int GlobalIds\nproperty int quality\nelement face 1\nproperty list uchar int "
    "vertex_indices\nproperty int Corners\nend_header\n0 0 0 5 6\n1 0 0 5 6\n0 1 0 5 6\n3 0 1 2 "
    "9\n");
  const ReadMesh mesh = importWhole(folder / "a.ply");
  EXPECT_EQ(mesh.counts.droppedColumns, (std::vector<std::string>{ "GlobalIds", "Corners" }));
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec.name, "quality");
  const ConversionReport report = convert(folder / "a.ply", folder / "a.vsm");
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_NE(report.notes[0].find("'GlobalIds'"), std::string::npos);
}

TEST(CellFlags, AreDeliveredWhateverIsChosen)
{
  TemporaryFolder folder;
  StreamMesh mesh = testStream(grid(5, 5));
  mesh.cellColumns.push_back(
    randomColumn({ CellFlagsName, ScalarType::UInt8, 1 }, mesh.cells(), 3));
  write(folder / "a.vsm", mesh);
  VsmReader reader(folder / "a.vsm");
  const StreamMesh stream = collect(*reader.source({}, { "cell numbers" }));
  ASSERT_EQ(stream.cellColumns.size(), 2u);
  EXPECT_EQ(stream.cellColumns[1].spec.name, CellFlagsName);
  EXPECT_EQ(stream.cellColumns[1].bytes, mesh.cellColumns.back().bytes);
  EXPECT_EQ(collect(*reader.source({}, { CellFlagsName })).cellColumns.size(), 1u);
  reader.selectColumns({}, {});
  MeshPiece piece;
  reader.readPiece(0, mesh.cells(), piece);
  ASSERT_EQ(piece.cellColumns.size(), 1u);
  EXPECT_EQ(piece.cellColumns[0].bytes, mesh.cellColumns.back().bytes);
}

} // namespace smg::testing
