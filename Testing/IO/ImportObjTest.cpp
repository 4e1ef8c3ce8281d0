// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/ColumnValues.h"
#include "Testing/Support/TestFolders.h"

namespace smg::testing
{
namespace
{

using ImportObj = ImportFixture;

const std::string Obj = "# two triangles and a quad\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\n"
                        "v 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nv 1 1 0\nf -1 -2 -3\n"
                        "v 2 0 0\nv 2 1 0\nf 2/1/1 5/2/1 \\\n 6/3/1 4/4/1\n";

} // namespace

TEST_F(ImportObj, PolygonsAndReferences)
{
  const ReadMesh mesh = this->read("a.obj", Obj);
  EXPECT_EQ(mesh.vertices(), 6);
  EXPECT_TRUE(mesh.doublePositions);
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 3, 2, 1, 1, 4, 5, 1, 5, 3 }));
  EXPECT_EQ(mesh.elements, (Numbers{ 0, 1, 2, 2 }));
  EXPECT_EQ(mesh.counts.triangulatedPolygons, 1);
}

TEST_F(ImportObj, FacesMayComeBeforeTheirVertices)
{
  const ReadMesh mesh = this->read("a.obj", "f 1/1 2/2 3/3\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\n");
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 }));
}

TEST_F(ImportObj, LinesAreContinued)
{
  const ReadMesh mesh =
    this->read("a.obj", "v 0 0 0 0.1 0.2 0.3\nv 1 \\\n0 \\\n0 0.5 \\\n 0.5 0.5\nv 0 1 0\n"
                        "f 1\\\n 2\\\n 3\ns off\nusemtl f\nl 1 2\ng v 1 2 3\n");
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 }));
}

TEST_F(ImportObj, ColoursOfAllVerticesAreAColumn)
{
  const std::string face = "f 1 2 3\n";
  const ReadMesh mesh =
    this->read("a.obj", "v 0 0 0 0.5 0.25 1\nv 1 0 0 1 1 1\nv 0 1 0 0 0 0.75\n" + face);
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Colors", ScalarType::Float32, 3 }));
  EXPECT_EQ(
    valuesOf(mesh.vertexColumns[0]), (std::vector<double>{ 0.5, 0.25, 1, 1, 1, 1, 0, 0, 0.75 }));
  // A weight is not a colour.
  EXPECT_TRUE(this->read("a.obj", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n" + face).counts.notes.empty());
}

TEST_F(ImportObj, WhatIsLeftOutIsNoted)
{
  const std::string others = "v 1 0 0\nv 0 1 0\n";
  const ReadMesh partly = this->read("a.obj", "v 0 0 0 0.1 0.2 0.3\n" + others + "f 1 2 3\n");
  EXPECT_TRUE(partly.vertexColumns.empty());
  ASSERT_EQ(partly.counts.notes.size(), 1u);
  EXPECT_NE(partly.counts.notes[0].find("colours of the vertices"), std::string::npos);
  const ReadMesh normals =
    this->read("a.obj", "v 0 0 0\n" + others + "vn 0 0 1\nf 1//1 2//1 3//1\n");
  ASSERT_EQ(normals.counts.notes.size(), 1u);
  EXPECT_NE(normals.counts.notes[0].find("Normals"), std::string::npos);
}

TEST_F(ImportObj, AByteOrderMarkIsNoPartOfTheFirstLine)
{
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";
  for (const char* name : { "a.obj", "a.txt" })
  {
    EXPECT_EQ(this->read(name, "\xEF\xBB\xBF" + text).vertices(), 4);
  }
}

TEST_F(ImportObj, PolygonsOfAnyLength)
{
  constexpr std::int64_t corners = 300000;
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (std::int64_t i = 0; i < corners; ++i)
  {
    text += i % 2 ? " 2/1/1" : " 3";
  }
  ASSERT_GT(text.size(), InputFile::WindowBytes);
  const ReadMesh mesh = this->read("a.obj", text);
  EXPECT_EQ(mesh.cells(), corners - 2);
  EXPECT_EQ(mesh.elementCount, 1);
  EXPECT_EQ((Numbers(mesh.corners.end() - 6, mesh.corners.end())), (Numbers{ 2, 1, 2, 2, 2, 1 }));
}

TEST_F(ImportObj, FacesOfFewerThanThreeCornersAreLeftOutAndCounted)
{
  const ReadMesh mesh =
    this->read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 3\nf 3 2 1\n");
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 2, 1, 0 }));
  EXPECT_EQ(mesh.elements, (Numbers{ 1, 3 }));
  ASSERT_EQ(mesh.counts.notes.size(), 1u);
  EXPECT_NE(mesh.counts.notes[0].find("2 faces have fewer than three"), std::string::npos);
}

TEST_F(ImportObj, ErrorsNameFileAndPlace)
{
  this->expectError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
    "a.obj, line 4: the corner 4 is not a vertex: they are 1 to 3");
  this->expectError("a.obj", "v 0 0 0\nv 1 x 0\n", "line 2: 'x' is not a number");
  this->expectError("a.obj", "v 0 0 nan\n", "line 1: 'nan' is not finite");
  this->expectError("a.obj", "v 0 0 1e999\n", "not finite");
  this->expectError("a.obj", "v 0 0\nv 0 0 0\n", "line 1: the file or line ends where");
  this->expectError("a.obj", "v 0 0 0\nf 1 -2 1\n", "line 2: a face names vertex -2");
  this->expectError("a.obj", "v 0 0 0\nf 1 0 1\n", "line 2: a face names vertex 0");
  this->expectError("a.obj", "v 0 0 0\nf 1 1\n", "no triangles");
  this->expectError("a.obj", "v 0 0 0\nf 1 1 1 99999999999\n", "line 2: the corner 99999999999");
  this->expectError("a.obj", "v 0 0 0\nf 1\\ 1 1\n", "line 2: there is a backslash");
  this->expectError("a.obj", "v 0 0 0\nf 1 1 \\\n x\n", "line 3: 'x' is not an integer");
  this->expectError("a.obj", "v 0 0 0\n", "no triangles");
}

TEST_F(ImportObj, DamageIsFound)
{
  this->expectDamageIsFound("a.obj", Obj);
}

TEST(ImportObjData, ArchiveMeshHasItsCounts)
{
  const std::filesystem::path folder = archiveFolder();
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  Workspace workspace({}, Workspace::MinMemory);
  const RawMesh mesh = importMesh(folder / "armadillo43k.obj", workspace);
  EXPECT_EQ(mesh.vertices, 43243);
  EXPECT_EQ(mesh.cells, 86482);
}

} // namespace smg::testing
