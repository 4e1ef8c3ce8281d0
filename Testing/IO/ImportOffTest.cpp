// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/ColumnValues.h"
#include "Testing/Support/TestFolders.h"

#include <limits>

namespace smg::testing
{
namespace
{

using ImportOff = ImportFixture;

const std::string CoffOff = "COFF # with colours\n4 3 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n\n"
                            "# between\n0 1 0 0 0 0 0\n1 1 0 9 9 9 9\n3 0 1 2\n3 1 3 2 255 0 0\n"
                            "2 0 1\n";

} // namespace

TEST_F(ImportOff, TheCountsMayFollowTheKeywordWithoutABlank)
{
  for (const char* begin : { "OFF3 1 0\n", "OFF3 1 0 # c\n", "# c\nCOFF3 1 0\n", "OFF 3 1 0\n" })
  {
    EXPECT_EQ(this->read("a", begin + std::string("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).corners,
      (Numbers{ 0, 1, 2 }))
      << begin;
  }
}

TEST_F(ImportOff, WithColours)
{
  const ReadMesh mesh = this->read("a.off", CoffOff);
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 1, 3, 2 }));
  EXPECT_EQ(mesh.elementCount, 3);
  EXPECT_EQ(mesh.counts.droppedCells, 1);
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Colors", ScalarType::UInt8, 4 }));
  EXPECT_EQ(valuesOf(mesh.vertexColumns[0]),
    (std::vector<double>{ 255, 0, 0, 255, 1, 1, 1, 1, 0, 0, 0, 0, 9, 9, 9, 9 }));
  // Not all faces have a colour.
  EXPECT_TRUE(mesh.elementColumns.empty());
}

TEST_F(ImportOff, WithNormalsColoursAndTextureCoordinates)
{
  const std::string vertices = "0 0 0 0 0 1 0.25 1 0 0.5 0.1\n1 0 0 0 0 1 1 1 1 0.5 1\n"
                               "0 1 0 1 0 0 0 0 0.5 0 0\n";
  const ReadMesh mesh =
    this->read("a.off", "STCNOFF\n3 2 0\n" + vertices + "3 0 1 2 255 0 7\n3 2 1 0 1 2 3\n");
  ASSERT_EQ(mesh.vertexColumns.size(), 3u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Normals", ScalarType::Float64, 3 }));
  EXPECT_EQ(valuesOf(mesh.vertexColumns[0]), (std::vector<double>{ 0, 0, 1, 0, 0, 1, 1, 0, 0 }));
  EXPECT_EQ(
    mesh.vertexColumns[1].spec, (ColumnSpec{ "TextureCoordinates", ScalarType::Float64, 2 }));
  // A text has the digits of doubles.
  EXPECT_EQ(valuesOf(mesh.vertexColumns[1]), (std::vector<double>{ 0.5, 0.1, 0.5, 1, 0, 0 }));
  EXPECT_EQ(mesh.vertexColumns[2].spec, (ColumnSpec{ "Colors", ScalarType::Float32, 3 }));
  EXPECT_EQ(
    valuesOf(mesh.vertexColumns[2]), (std::vector<double>{ 0.25, 1, 0, 1, 1, 1, 0, 0, 0.5 }));
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(mesh.elementColumns[0].spec, (ColumnSpec{ "Colors", ScalarType::UInt8, 3 }));
  EXPECT_EQ(valuesOf(mesh.elementColumns[0]), (std::vector<double>{ 255, 0, 7, 1, 2, 3 }));
}

TEST_F(ImportOff, BlackTellsNotWhatKindTheColoursAre)
{
  const std::string face = "3 0 1 2\n";
  const auto colors = [&](const std::string& last)
  {
    const ReadMesh mesh =
      this->read("a.off", "COFF\n3 1 0\n0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 " + last + "\n" + face);
    EXPECT_EQ(mesh.vertexColumns.size(), 1u);
    return mesh.vertexColumns.at(0);
  };
  const Column bytes = colors("200 100 0");
  EXPECT_EQ(bytes.spec.type, ScalarType::UInt8);
  EXPECT_EQ(valuesOf(bytes), (std::vector<double>{ 0, 0, 0, 0, 0, 0, 200, 100, 0 }));
  const Column shares = colors("0.5 1 0");
  EXPECT_EQ(shares.spec.type, ScalarType::Float32);
  EXPECT_EQ(valuesOf(shares), (std::vector<double>{ 0, 0, 0, 0, 0, 0, 0.5, 1, 0 }));
  EXPECT_EQ(valuesOf(colors("0 0 0")), std::vector<double>(9));
}

TEST_F(ImportOff, ColoursOfTwoKindsAreLeftOut)
{
  const ReadMesh mesh = this->read(
    "a.off", "COFF\n3 1 0\n0 0 0 0.5 0 0\n1 0 0 7 0 0\n0 1 0 1 0 0\n3 0 1 2 nan nan nan\n");
  EXPECT_TRUE(mesh.vertexColumns.empty());
  ASSERT_EQ(mesh.counts.notes.size(), 1u);
  EXPECT_NE(mesh.counts.notes[0].find("colours of the vertices"), std::string::npos);
}

TEST_F(ImportOff, AllVerticesHaveAsManyNumbers)
{
  this->expectError("a.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0\n0 1 0 0 0 1\n3 0 1 2\n",
    "line 4: a vertex has 2 numbers behind its coordinates, those before it have 3");
}

TEST_F(ImportOff, WithAnyKeywordOrNone)
{
  const std::string points = "0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n";
  for (const char* keyword : { "OFF\n", "OFF ", "NOFF\n", "STOFF\n", "STCNOFF\r\n", "" })
  {
    const ReadMesh mesh = this->read("a.off", keyword + ("3 1 0\n" + points + "3 0 1 2\n"));
    EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 })) << keyword;
    EXPECT_EQ(mesh.positions[7], 1) << keyword;
  }
}

TEST_F(ImportOff, MeshesKeepTheirBits)
{
  const IndexedTestMesh mesh = torus(20, 30, 0.1);
  const ReadMesh read = this->read("a.off", meshText(mesh));
  EXPECT_EQ(read.positions, mesh.positions);
  EXPECT_EQ(read.corners, mesh.corners);
}

TEST_F(ImportOff, ErrorsNameFileAndPlace)
{
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  this->expectError(
    "a.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n", "line 6: the corner 3 is not a vertex");
  this->expectError("a.off", "OFF\n3 1 0\n" + points + "3 0 -1 2\n", "line 6: the corner -1");
  this->expectError("a.off", "OFF\n9999999999 1 0\n0 0 0\n", "line 2: 9999999999 cannot be");
  this->expectError("a.off", "OFF\n-3 1 0\n0 0 0\n", "line 2: -3 cannot be");
  this->expectError("a.off", "OFF\n3 1 0\n" + points + "3 0 1", "line 6");
  this->expectError("a.off", "OFF\n3 1 0\n" + points + "900 0 1 2\n", "line 6: 900 cannot be");
  this->expectError("a.off", "OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "line 4: 'inf'");
  this->expectError("a.off", "4OFF\n3 1 0\n", "line 1: the vertices of a '4OFF'");
  this->expectError("a.off", "OFF\n3 0 0\n" + points, "no triangles");
}

TEST_F(ImportOff, DamageIsFound)
{
  this->expectDamageIsFound("a.off", CoffOff);
}

namespace
{

/** The number, most significant byte first. */
template <class T>
std::string bigEndian(T value)
{
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
  std::ranges::reverse(bytes);
  return bytes;
}

std::string integers(std::initializer_list<std::int32_t> values)
{
  std::string bytes;
  for (const std::int32_t value : values)
  {
    bytes += bigEndian(value);
  }
  return bytes;
}

std::string reals(std::initializer_list<float> values)
{
  std::string bytes;
  for (const float value : values)
  {
    bytes += bigEndian(value);
  }
  return bytes;
}

/** Three vertices with normals, colours and texture coordinates, a triangle and a line. */
std::string binaryOff()
{
  std::string file = "# a comment\nSTCNOFF BINARY\n" + integers({ 3, 2, 0 });
  file += reals({ 0, 0, 0, 0, 0, 1, 0.25F, 1, 0, 1, 0.5F, 0.125F });
  file += reals({ 1, 0, 0, 0, 0, 1, 1, 1, 1, 1, 0.5F, 1 });
  file += reals({ 0, 0.1F, 0, 1, 0, 0, 0, 0, 0.5F, 0, 0, 0 });
  file += integers({ 3, 0, 1, 2, 3 }) + reals({ 1, 0, 0.5F });
  return file + integers({ 2, 1, 0, 3 }) + reals({ 0, 0, 0.25F });
}

} // namespace

TEST_F(ImportOff, BinaryFilesAreTheSameMeshes)
{
  const ReadMesh mesh = this->read("a.off", binaryOff());
  EXPECT_EQ(
    mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, static_cast<double>(0.1F), 0 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 }));
  EXPECT_EQ(mesh.counts.droppedCells, 1);
  ASSERT_EQ(mesh.vertexColumns.size(), 3u);
  EXPECT_EQ(valuesOf(mesh.vertexColumns[0]), (std::vector<double>{ 0, 0, 1, 0, 0, 1, 1, 0, 0 }));
  EXPECT_EQ(valuesOf(mesh.vertexColumns[1]), (std::vector<double>{ 0.5, 0.125, 0.5, 1, 0, 0 }));
  EXPECT_EQ(mesh.vertexColumns[2].spec, (ColumnSpec{ "Colors", ScalarType::Float32, 4 }));
  EXPECT_EQ(valuesOf(mesh.vertexColumns[2]),
    (std::vector<double>{ 0.25, 1, 0, 1, 1, 1, 1, 1, 0, 0, 0.5, 0 }));
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(valuesOf(mesh.elementColumns[0]), (std::vector<double>{ 1, 0, 0.5, 0, 0, 0.25 }));
}

TEST_F(ImportOff, ErrorsOfBinaryFilesNameTheByte)
{
  const std::string head = "OFF BINARY\n";
  const std::string points = reals({ 0, 0, 0, 1, 0, 0, 0, 1, 0 });
  const auto expectRefused = [this](const std::string& file, const std::string& part)
  { this->expectError("a.off", file, part); };
  expectRefused(head + integers({ 3, 1, 0 }) + points + integers({ 3, 0, 1, 3, 0 }),
    "a.off, byte 75: the corner 3 is not a vertex");
  expectRefused(head + integers({ 3, 1, 0 }) + points + integers({ 3, 0, 1, 2 }), "byte 75");
  expectRefused(head + integers({ 3, 1, 0 }) + points + integers({ 3, 0, 1, 2, 0, 0 }),
    "more after the last face");
  expectRefused(head + integers({ 3, 1, 0 }) + points + integers({ 3, 0, 1, 2, 5 }), "colour");
  expectRefused(
    head + integers({ 3, 1, 0 }) + points + integers({ -3, 0, 1, 2, 0 }), "-3 cannot be");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expectRefused(head + integers({ 3, 1, 0 }) + reals({ 0, 0, 0, 1, nan, 0, 0, 1, 0 }) +
                  integers({ 3, 0, 1, 2, 0 }),
    "vertex 1: a coordinate is not finite");
  expectRefused("NOFF BINARY\n" + integers({ 1, 0, 0 }) + reals({ 0, 0, 0, 0, nan, 1 }),
    "a.off, byte 44: vertex 0: a number behind its coordinates is not finite");
  expectRefused(head + integers({ 3, 1 << 24, 0 }) + points, "cannot be the number of faces");
  expectRefused(head + std::string("\3\0\0\0\1\0\0\0\0\0\0\0", 12) + points,
    "cannot be the number of vertices");
  this->expectDamageIsFound("a.off", binaryOff());
}

TEST(ImportOffData, ArchiveMeshHasItsCounts)
{
  const std::filesystem::path folder = archiveFolder();
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  Workspace workspace({}, Workspace::MinMemory);
  const RawMesh mesh = importMesh(folder / "elephant44k.off", workspace);
  EXPECT_EQ(mesh.vertices, 44460);
  EXPECT_EQ(mesh.cells, 88928);
}

} // namespace smg::testing
