// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/TestFolders.h"

#include <array>

namespace smg::testing
{
namespace
{

using ImportPly = ImportFixture;

/** Two triangles and a quadrilateral of a PLY file, faces before vertices, with other elements. */
std::string binaryPly(bool big)
{
  std::string bytes =
    std::string("ply\nformat binary_") + (big ? "big" : "little") +
    "_endian 1.0\ncomment made by hand\nelement camera 1\nproperty list uchar float view\n"
    "element face 3\nproperty uchar intensity\nproperty list uchar int vertex_indices\n"
    "property list ushort double texcoord\nelement vertex 5\nproperty uchar red\n"
    "property double z\nproperty float y\nproperty short x\nproperty uchar green\n"
    "property uchar blue\nproperty int id\nend_header\n";
  put<std::uint8_t>(bytes, 2);
  put(bytes, 1.0f, big);
  put(bytes, 2.0f, big);
  const std::vector<std::vector<std::int32_t>> faces{ { 0, 1, 2 }, { 1, 3, 4, 2 }, { 2, 4, 0 } };
  for (const auto& face : faces)
  {
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(face.size()) * 10);
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(face.size()));
    for (const std::int32_t corner : face)
    {
      put(bytes, corner, big);
    }
    put<std::uint16_t>(bytes, 1, big);
    put(bytes, 0.5, big);
  }
  for (int i = 0; i < 5; ++i)
  {
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(i));
    put(bytes, i / 3.0, big);
    put(bytes, static_cast<float>(i * i), big);
    put(bytes, static_cast<std::int16_t>(i - 2), big);
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(100 + i));
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(200 + i));
    put<std::int32_t>(bytes, -7 * i, big);
  }
  return bytes;
}

const std::string AsciiPly = "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\n"
                             "property float y\r\nproperty float z\r\nproperty float nx\r\n"
                             "property float ny\r\nproperty float nz\r\nelement tristrips 1\r\n"
                             "property list int int vertex_indices\r\nend_header\r\n"
                             "0 0 0 0 0 1\r\n1 0 0.1 0 0 1\r\n0 1 0 nan 0 1\r\n1 1 +1e-3 0 0 1\r\n"
                             "8 0 1 2 3 -1 1 2 3\r\n";

/** The header of a text file of three vertices, up to the elements after them. */
const std::string ThreeVertices = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                  "property float y\nproperty float z\n";
const std::string ThreePoints = "end_header\n0 0 0\n1 0 0\n0 1 0\n";

/** A binary file of a strip of this many vertices, one list. */
std::string longStrip(std::int32_t vertices)
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(vertices) +
                      "\nproperty float x\nproperty float y\nproperty float z\n"
                      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  for (std::int32_t i = 0; i < vertices; ++i)
  {
    put(bytes, static_cast<float>(i));
    put(bytes, static_cast<float>(i % 2));
    put(bytes, 0.0f);
  }
  put(bytes, vertices);
  for (std::int32_t i = 0; i < vertices; ++i)
  {
    put(bytes, i);
  }
  return bytes;
}

} // namespace

TEST_F(ImportPly, BinaryInBothOrders)
{
  for (const bool big : { false, true })
  {
    const ReadMesh mesh = this->read("a.ply", binaryPly(big));
    EXPECT_EQ(mesh.vertices(), 5);
    EXPECT_TRUE(mesh.doublePositions);
    EXPECT_EQ(mesh.positions[6], 0.0);
    EXPECT_EQ(mesh.positions[7], 4.0);
    EXPECT_EQ(mesh.positions[8], 2 / 3.0);
    EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 1, 3, 4, 1, 4, 2, 2, 4, 0 }));
    EXPECT_EQ(mesh.elements, (Numbers{ 0, 1, 1, 2 }));
    EXPECT_EQ(mesh.counts.triangulatedPolygons, 1);
    ASSERT_EQ(mesh.vertexColumns.size(), 2u);
    EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Colors", ScalarType::UInt8, 3 }));
    EXPECT_EQ(mesh.vertexColumns[0].value(4, 0), 4);
    EXPECT_EQ(mesh.vertexColumns[0].value(4, 2), 204);
    EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "id", ScalarType::Int32, 1 }));
    EXPECT_EQ(mesh.vertexColumns[1].value(4), -28);
    ASSERT_EQ(mesh.elementColumns.size(), 1u);
    EXPECT_EQ(mesh.elementColumns[0].spec.name, "intensity");
    EXPECT_EQ(mesh.elementColumns[0].value(0), 30);
    EXPECT_EQ(mesh.elementColumns[0].value(1), 40);
    EXPECT_EQ(mesh.elementColumns[0].value(2), 30);
  }
}

TEST_F(ImportPly, AsciiWithStrips)
{
  const ReadMesh mesh = this->read("a.ply", AsciiPly);
  EXPECT_FALSE(mesh.doublePositions);
  EXPECT_EQ(mesh.positions[5], static_cast<double>(0.1f));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 2, 1, 3, 1, 2, 3 }));
  EXPECT_EQ(mesh.elements, (Numbers{ 0, 0, 0 }));
  EXPECT_EQ(mesh.counts.triangulatedPolygons, 1);
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Normals", ScalarType::Float32, 3 }));
  EXPECT_EQ(mesh.vertexColumns[0].value(1, 2), 1);
}

TEST_F(ImportPly, PolygonsPointsAndLines)
{
  const ReadMesh mesh =
    this->read("a.ply", ThreeVertices +
                          "element face 4\nproperty list uchar double vertex_index\n"
                          "property int part\n" +
                          ThreePoints + "1 0 10\n5 0 1 2 1 0 11\n0 12\n3 2 1 0 13\n");
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 0, 2, 1, 0, 1, 0, 2, 1, 0 }));
  EXPECT_EQ(mesh.elements, (Numbers{ 1, 1, 1, 3 }));
  EXPECT_EQ(mesh.counts.droppedCells, 2);
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(mesh.elementColumns[0].value(3), 13);
}

TEST_F(ImportPly, AttributesOfFacesAndStripsTogetherAreLeftOut)
{
  const ReadMesh mesh = this->read(
    "a.ply", ThreeVertices +
               "element face 1\nproperty list uchar int vertex_indices\nproperty int part\n"
               "element tristrips 1\nproperty list uchar int vertex_indices\n" +
               ThreePoints + "3 0 1 2 7\n3 2 1 0\n");
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 2, 1, 0 }));
  EXPECT_TRUE(mesh.elementColumns.empty());
  EXPECT_EQ(mesh.counts.notes.size(), 1u);
}

TEST_F(ImportPly, ManyAttributesFitIntoTheLeastMemory)
{
  constexpr int count = 1000;
  std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\n";
  std::string values;
  for (int i = 0; i < count; ++i)
  {
    header += "property short a" + std::to_string(i) + '\n';
    values += ' ' + std::to_string(i);
  }
  header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const ReadMesh mesh = this->read(
    "a.ply", header + "0 0 0" + values + "\n1 0 0" + values + "\n0 1 0" + values + "\n3 0 1 2\n");
  ASSERT_EQ(mesh.vertexColumns.size(), std::size_t(count));
  EXPECT_EQ(mesh.vertexColumns[count - 1].value(2), count - 1);
}

TEST_F(ImportPly, AnElementWithoutRecordsHasNoColumns)
{
  const ReadMesh mesh = this->read(
    "a.ply", ThreeVertices +
               "element face 0\nproperty list uchar int vertex_indices\nproperty int none\n"
               "element tristrips 1\nproperty float weight\n"
               "property list uchar int vertex_indices\n" +
               ThreePoints + "0.5 3 0 1 2\n");
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(mesh.elementColumns[0].spec.name, "weight");
}

TEST_F(ImportPly, ReservedNamesAndHalfGroups)
{
  const ReadMesh mesh = this->read("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty uchar Position\n"
    "property float y\nproperty float nx\nproperty float z\nproperty double ny\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 9 0 1 0 2\n1 9 0 3 0 4\n0 9 1 5 0 6\n3 0 1 2\n");
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  EXPECT_EQ(mesh.counts.droppedColumns, (std::vector<std::string>{ "Position" }));
  ASSERT_EQ(mesh.vertexColumns.size(), 2u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "nx", ScalarType::Float32, 1 }));
  EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "ny", ScalarType::Float64, 1 }));
  EXPECT_EQ(mesh.vertexColumns[1].value(2), 6);
}

TEST_F(ImportPly, StripsOfAnyLength)
{
  // One list that is longer than the window of the file in memory.
  constexpr std::int32_t vertices = 600000;
  static_assert(vertices * sizeof(std::int32_t) > 2 * InputFile::WindowBytes);
  writeBytes(this->Folder / "strip.ply", longStrip(vertices));
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  const RawMesh mesh = importMesh(this->Folder / "strip.ply", workspace);
  EXPECT_EQ(mesh.cells, vertices - 2);
  EXPECT_EQ(mesh.elementCount, 1);
  RecordFile<std::uint32_t>::Reader reader(mesh.corners);
  for (std::uint32_t i = 0; i + 2 < std::uint32_t(vertices); ++i)
  {
    std::array<std::uint32_t, 3> corners{};
    ASSERT_TRUE(reader.next(corners));
    ASSERT_EQ(corners, (i % 2 ? std::array{ i + 1, i, i + 2 } : std::array{ i, i + 1, i + 2 }));
  }
}

TEST_F(ImportPly, ListsThatAreSkippedMayBeLong)
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement blob 1\n"
                      "property list uint double numbers\nelement vertex 3\nproperty float x\n"
                      "property float y\nproperty float z\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n";
  put<std::uint32_t>(bytes, 400000);
  bytes.append(400000 * sizeof(double), 'x');
  for (const float coordinate : { 0, 0, 0, 1, 0, 0, 0, 1, 0 })
  {
    put(bytes, coordinate);
  }
  put<std::uint8_t>(bytes, 3);
  for (const std::int32_t corner : { 0, 1, 2 })
  {
    put(bytes, corner);
  }
  EXPECT_EQ(this->read("a.ply", bytes).corners, (Numbers{ 0, 1, 2 }));
}

TEST_F(ImportPly, UnknownLinesOfTheHeaderAreNoted)
{
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  std::string text = ThreeVertices + face + ThreePoints + "3 0 1 2\n";
  text.replace(text.find("element vertex"), 0, "obj_note made by hand\n");
  const ReadMesh mesh = this->read("a.ply", text);
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 }));
  ASSERT_EQ(mesh.counts.notes.size(), 1u);
  EXPECT_NE(mesh.counts.notes[0].find("'obj_note'"), std::string::npos) << mesh.counts.notes[0];
  // An element is recognised by its properties.
  text.replace(text.find("element face"), 7, "elment");
  this->expectError("a.ply", text, "line 8: 'elment' is not a keyword of a PLY header");
  text.replace(text.find("elment face 1"), 13, "elment face 1\ncomment between");
  this->expectError("a.ply", text, "line 8: 'elment' is not a keyword of a PLY header");
  this->expectError("a.ply", "ply\nformat ascii 1.0\nElement vertex 3\n", "'Element' is not");
}

TEST_F(ImportPly, ErrorsNameFileAndPlace)
{
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  this->expectError("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 999999\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0 0 0\n",
    "999999 cannot be the number of records of element 'vertex'");
  this->expectError("a.ply", "ply\nformat ascii 1.0\n", "line 3: the file ends in its header");
  for (const char* cut : { "ply\nformat asc", "ply\nformat ascii 1.0\nelement vertex",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty flo" })
  {
    this->expectError("a.ply", cut, "the file ends in its header");
  }
  this->expectError("a.ply", "ply\nend_header\n", "line 2: the header has no format line");
  this->expectError("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n",
    "line 4: 'real' is not a PLY type");
  this->expectError("a.ply", ThreeVertices + face + ThreePoints + "3 0 1 3\n",
    "line 13: record 0 of element 'face': the corner 3 is not a vertex: they are 0 to 2");
  this->expectError("a.ply", ThreeVertices + face + ThreePoints + "3 0 1 -1\n", "the corner -1");
  this->expectError(
    "a.ply", ThreeVertices + face + ThreePoints + "3 0 1.5 2\n", "range of its type");
  this->expectError("a.ply", ThreeVertices + face + "end_header\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n",
    "line 11: record 1 of element 'vertex': a coordinate is not finite");
  this->expectError("a.ply", ThreeVertices + face + ThreePoints + "99 0 1 2\n",
    "99 cannot be the length of a list");
  this->expectError("a.ply", ThreeVertices + ThreePoints, "no triangles");
  this->expectError("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 "
    "0\n",
    "no properties x, y and z");
  this->expectError(
    "a.ply", ThreeVertices + "element face 99999999999\n" + ThreePoints, "no triangles");
  std::string truncated = binaryPly(false);
  truncated.resize(truncated.size() - 3);
  this->expectError(
    "a.ply", truncated, "record 4 of element 'vertex': the file ends where a number should be");
}

TEST_F(ImportPly, HeadersOfAnyLengthNeedNoMemory)
{
  std::string header = "ply\nformat ascii 1.0\nelement vertex 0\n";
  for (int i = 0; i < 5000; ++i)
  {
    header += "property float p" + std::to_string(i) + "\n";
  }
  this->expectError("a.ply", header, "line 4099: the header has more than 4096 elements");
}

TEST_F(ImportPly, HeadersOfManyCommentsAreRefused)
{
  const auto with = [](std::size_t comments)
  {
    std::string header = "ply\nformat ascii 1.0\n";
    for (std::size_t k = 0; k < comments; ++k)
    {
      header += "comment " + std::string(991, 'x') + "\n";
    }
    return header + AsciiPly.substr(AsciiPly.find("element"));
  };
  EXPECT_EQ(this->read("a.ply", with(1000)).corners, this->read("b.ply", AsciiPly).corners);
  this->expectError("a.ply", with(1100), "line 1052: the header has more than 1 MiB");
}

TEST_F(ImportPly, DamageIsFound)
{
  this->expectDamageIsFound("a.ply", AsciiPly);
  this->expectDamageIsFound("b.ply", binaryPly(false));
  this->expectDamageIsFound("c.ply", binaryPly(true));
}

TEST(ImportPlyData, ArchiveMeshesHaveTheirCounts)
{
  const std::filesystem::path folder = archiveFolder();
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  struct Expected
  {
    const char* file;
    std::int64_t vertices, cells;
  };
  constexpr Expected expected[] = { { "bunny.ply", 35947, 69451 }, { "dragon.ply", 437645, 871414 },
    { "horse_be.ply", 48485, 96966 }, { "rangemap_lato315.ply", 62702, 120995 } };
  for (const Expected& each : expected)
  {
    Workspace workspace({}, Workspace::MinMemory);
    const RawMesh mesh = importMesh(folder / each.file, workspace);
    EXPECT_EQ(mesh.cellType, CellType::Triangle) << each.file;
    EXPECT_EQ(mesh.vertices, each.vertices) << each.file;
    EXPECT_EQ(mesh.cells, each.cells) << each.file;
  }
}

} // namespace smg::testing
