// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Importer.h"

#include "Solver/Core/Error.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

using namespace smg;
using namespace smg::testing;

namespace
{

/** Appends the bytes of a value, in the other byte order if `big`. */
template <class T>
void put(std::string& bytes, T value, bool big = false)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  bytes.append(raw, sizeof(T));
}

/** Two triangles and a quadrilateral of a PLY file, faces before vertices, and things around. */
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

const char* const AsciiPly = "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\n"
                             "property float y\r\nproperty float z\r\nproperty float nx\r\n"
                             "property float ny\r\nproperty float nz\r\nelement tristrips 1\r\n"
                             "property list int int vertex_indices\r\nend_header\r\n"
                             "0 0 0 0 0 1\r\n1 0 0.1 0 0 1\r\n0 1 0 nan 0 1\r\n1 1 +1e-3 0 0 1\r\n"
                             "8 0 1 2 3 -1 1 2 3\r\n";

const char* const Obj = "# two triangles and a quad\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\n"
                        "v 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nv 1 1 0\nf -1 -2 -3\n"
                        "v 2 0 0\nv 2 1 0\nf 2/1/1 5/2/1 \\\n 6/3/1 4/4/1\n";

const char* const CoffOff = "COFF # with colours\n4 3 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n\n"
                            "# between\n0 1 0 0 0 0 0\n1 1 0 9 9 9 9\n3 0 1 2\n3 1 3 2 255 0 0\n"
                            "2 0 1\n";

const char* const Medit = "MeshVersionFormatted 1\nDimension\n3\n# the points\nVertices 5\n"
                          "0 0 0 1\n1 0 0 1\n0 1 0 2\n0 0 1 2\n1 1 1 3\nCorners 1\n1\nTriangles 1\n"
                          "1 2 3 7\nTetrahedra\n2\n1 2 3 4 8\n2 3 4 5 9\nEnd\n";

const char* const Gmsh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"skin\"\n"
                          "$EndPhysicalNames\n$Nodes\n4\n10 0 0 0\n11 1 0 0\n12 0 1 0\n99 1 1 0\n"
                          "$EndNodes\n$Elements\n3\n1 1 2 0 1 10 11\n2 2 2 0 1 10 11 12\n"
                          "3 2 0 11 99 12\n$EndElements\n";

const char* const Gmsh4 =
  "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 5 1 5\n3 1 0 2\n1\n2\n0 0 0\n1 0 0\n"
  "3 2 0 3\n5\n4\n3\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n$Elements\n2 3 1 3\n2 1 2 1\n1 1 2 5\n"
  "3 1 4 2\n2 1 2 5 4\n3 2 5 4 3\n$EndElements\n";

const char* const Stl = "solid two\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "vertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                        "vertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

std::string binaryStl()
{
  std::string bytes = "solid, but binary";
  bytes.resize(80, ' ');
  put<std::uint32_t>(bytes, 2);
  const float corners[2][9] = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 1, 0, 0, 1, 1, 0, 0, 1, 0 } };
  for (const auto& triangle : corners)
  {
    bytes.append(12, '\0');
    for (const float coordinate : triangle)
    {
      put(bytes, coordinate);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

class Import : public ::testing::Test
{
protected:
  IndexedMesh read(const std::string& name, std::string_view bytes)
  {
    writeBytes(this->Folder / name, bytes);
    return importMesh(this->Folder / name);
  }

  std::string errorOf(const std::string& name, std::string_view bytes)
  {
    try
    {
      this->read(name, bytes);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder Folder;
};

using Corners = std::vector<std::int64_t>;

#define EXPECT_CONTAINS(text, part) EXPECT_PRED_FORMAT2(::testing::IsSubstring, part, text)

} // namespace

TEST_F(Import, BinaryPlyInBothOrders)
{
  for (const bool big : { false, true })
  {
    const IndexedMesh mesh = this->read("a.ply", binaryPly(big));
    EXPECT_EQ(mesh.vertices(), 5);
    EXPECT_TRUE(mesh.doublePositions);
    EXPECT_EQ(mesh.positions[6], 0.0);
    EXPECT_EQ(mesh.positions[7], 4.0);
    EXPECT_EQ(mesh.positions[8], 2 / 3.0);
    EXPECT_EQ(mesh.corners, (Corners{ 0, 1, 2, 1, 3, 4, 1, 4, 2, 2, 4, 0 }));
    EXPECT_EQ(mesh.originalCells, (Corners{ 0, 1, 1, 2 }));
    EXPECT_EQ(mesh.triangulatedPolygons, 1);
    ASSERT_EQ(mesh.vertexColumns.size(), 2u);
    EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Colors", ScalarType::UInt8, 3 }));
    EXPECT_EQ(mesh.vertexColumns[0].value(4, 0), 4);
    EXPECT_EQ(mesh.vertexColumns[0].value(4, 2), 204);
    EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "id", ScalarType::Int32, 1 }));
    EXPECT_EQ(mesh.vertexColumns[1].value(4), -28);
    ASSERT_EQ(mesh.cellColumns.size(), 1u);
    EXPECT_EQ(mesh.cellColumns[0].spec.name, "intensity");
    EXPECT_EQ(mesh.cellColumns[0].value(2), 40);
    EXPECT_EQ(mesh.cellColumns[0].value(3), 30);
  }
}

TEST_F(Import, AsciiPlyWithStrips)
{
  const IndexedMesh mesh = this->read("a.ply", AsciiPly);
  EXPECT_FALSE(mesh.doublePositions);
  EXPECT_EQ(mesh.positions[5], static_cast<double>(0.1f));
  EXPECT_EQ(mesh.corners, (Corners{ 0, 1, 2, 2, 1, 3, 1, 2, 3 }));
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Normals", ScalarType::Float32, 3 }));
}

TEST_F(Import, Obj)
{
  const IndexedMesh mesh = this->read("a.obj", Obj);
  EXPECT_EQ(mesh.vertices(), 6);
  EXPECT_EQ(mesh.corners, (Corners{ 0, 1, 2, 3, 2, 1, 1, 4, 5, 1, 5, 3 }));
  EXPECT_EQ(mesh.triangulatedPolygons, 1);
}

TEST_F(Import, OffWithColours)
{
  const IndexedMesh mesh = this->read("a.off", CoffOff);
  EXPECT_EQ(mesh.vertices(), 4);
  EXPECT_EQ(mesh.corners, (Corners{ 0, 1, 2, 1, 3, 2 }));
  EXPECT_EQ(mesh.droppedCells, 1);
}

TEST_F(Import, MeditTetrahedraWinOverTriangles)
{
  const IndexedMesh mesh = this->read("a.mesh", Medit);
  EXPECT_EQ(mesh.cellType, CellType::Tetrahedron);
  EXPECT_EQ(mesh.vertices(), 5);
  EXPECT_EQ(mesh.corners, (Corners{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(mesh.droppedCells, 1);
  EXPECT_EQ(mesh.originalCells, (Corners{ 1, 2 }));
  ASSERT_EQ(mesh.cellColumns.size(), 1u);
  EXPECT_EQ(mesh.cellColumns[0].value(1), 9);
}

TEST_F(Import, GmshOfBothVersions)
{
  const IndexedMesh two = this->read("a.msh", Gmsh2);
  EXPECT_EQ(two.corners, (Corners{ 0, 1, 2, 1, 3, 2 }));
  EXPECT_EQ(two.droppedCells, 1);
  const IndexedMesh four = this->read("a.msh", Gmsh4);
  EXPECT_EQ(four.cellType, CellType::Tetrahedron);
  EXPECT_EQ(four.corners, (Corners{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(four.positions[3 * 4 + 2], 1.0);
}

TEST_F(Import, StlIsWelded)
{
  for (const std::string& bytes : { std::string(Stl), binaryStl() })
  {
    const IndexedMesh mesh = this->read("a.stl", bytes);
    EXPECT_EQ(mesh.vertices(), 4);
    EXPECT_EQ(mesh.corners, (Corners{ 0, 1, 2, 1, 3, 2 }));
  }
}

TEST_F(Import, FormatIsKnownByContent)
{
  EXPECT_EQ(this->read("a.obj", AsciiPly).cells(), 3);
  EXPECT_EQ(this->read("noSuffix", CoffOff).cells(), 2);
  EXPECT_EQ(this->read("a.off", Medit).cells(), 2);
}

TEST_F(Import, ErrorsNameFileAndPlace)
{
  EXPECT_CONTAINS(this->errorOf("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "a.obj, line 4");
  EXPECT_CONTAINS(this->errorOf("a.obj", "v 0 0 0\nv 1 x 0\n"), "line 2: 'x' is no number");
  EXPECT_CONTAINS(this->errorOf("a.obj", "v 0 0 nan\n"), "line 1: 'nan' is not finite");
  EXPECT_CONTAINS(this->errorOf("a.obj", "v 0 0 1e999\n"), "not finite");
  EXPECT_CONTAINS(this->errorOf("a.obj", "v 0 0 0\nf 1 -2 1\n"), "line 2");
  EXPECT_CONTAINS(this->errorOf("a.obj", "v 0 0 0\n"), "no triangles");
  EXPECT_CONTAINS(this->errorOf("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "line 6");
  EXPECT_CONTAINS(this->errorOf("a.off", "OFF\n9999999999 1 0\n0 0 0\n"), "line 2");
  EXPECT_CONTAINS(this->errorOf("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1"), "line 6");
  EXPECT_CONTAINS(this->errorOf("a.mesh", "MeshVersionFormatted 1\nDimension 4\n"), "line 2");
  EXPECT_CONTAINS(this->errorOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 999999\nproperty "
                                         "float x\nproperty float y\nproperty float z\n"
                                         "end_header\n0 0 0\n"),
    "truncated");
  EXPECT_CONTAINS(this->errorOf("a.ply", "ply\nformat ascii 1.0\n"), "line 3");
  EXPECT_CONTAINS(this->errorOf("a.ply", ""), "empty");
  EXPECT_CONTAINS(this->errorOf("a.xyz", "1 2 3"), "format is not known");
  EXPECT_CONTAINS(this->errorOf("a.vtp", "<VTKFile type=\"PolyData\">"), "without VTK");
  std::string truncated = binaryPly(false);
  truncated.resize(truncated.size() - 3);
  EXPECT_CONTAINS(this->errorOf("a.ply", truncated), "record 4 of element 'vertex'");
  EXPECT_THROW(importMesh(this->Folder / "missing.ply"), Error);
  EXPECT_THROW(importMesh(this->Folder.path()), Error);
}

TEST_F(Import, MemoryIsCheckedBeforeTheMeshIsRead)
{
  const IndexedTestMesh mesh = grid(200, 200);
  writeBytes(this->Folder / "a.off", meshText(mesh));
  ImportOptions options;
  options.budget = MemoryBudget(1 << 20);
  try
  {
    importMesh(this->Folder / "a.off", options);
    FAIL() << "the limit was not checked";
  }
  catch (const Error& error)
  {
    EXPECT_CONTAINS(std::string(error.what()), "1 MiB are allowed");
    EXPECT_CONTAINS(std::string(error.what()), "40000 vertices");
  }
}

TEST_F(Import, StlThatIsNoClosedMeshNeedsMore)
{
  // Triangles that share no vertex: six times as many vertices as a closed mesh has.
  constexpr std::uint32_t Triangles = 200000;
  std::string bytes(80, ' ');
  put(bytes, Triangles);
  for (std::uint32_t i = 0; i < Triangles; ++i)
  {
    for (int k = 0; k < 12; ++k)
    {
      put(bytes, k < 3 ? 0.0f : static_cast<float>(i) + 0.01f * static_cast<float>(k * k));
    }
    bytes += std::string(2, '\0');
  }
  writeBytes(this->Folder / "soup.stl", bytes);
  MeshSizes sizes;
  sizes.cells = Triangles;
  sizes.vertices = Triangles;
  sizes.vertexColumnBytes = 56;
  ImportOptions options;
  options.budget = MemoryBudget(MemoryBudget::bytesFor(sizes));
  EXPECT_THROW(importMesh(this->Folder / "soup.stl", options), Error);
  EXPECT_EQ(importMesh(this->Folder / "soup.stl").vertices(), 3 * std::int64_t(Triangles));
}

TEST_F(Import, CancelEndsIt)
{
  writeBytes(this->Folder / "a.off", meshText(grid(20, 20)));
  ImportOptions options;
  options.progress = [](double) { return false; };
  EXPECT_THROW(importMesh(this->Folder / "a.off", options), Cancelled);
}

/** Whatever happens to a file, it is read or refused with an Error, and its mesh is valid. */
TEST_F(Import, DamagedFilesAreRefusedOrValid)
{
  const std::pair<const char*, std::string> files[] = { { "a.ply", AsciiPly },
    { "b.ply", binaryPly(false) }, { "c.ply", binaryPly(true) }, { "a.obj", Obj },
    { "a.off", CoffOff }, { "a.mesh", Medit }, { "a.msh", Gmsh2 }, { "b.msh", Gmsh4 },
    { "a.stl", Stl }, { "b.stl", binaryStl() } };
  const auto attempt = [this](const char* name, const std::string& bytes)
  {
    try
    {
      const IndexedMesh mesh = this->read(name, bytes);
      for (const std::int64_t corner : mesh.corners)
      {
        ASSERT_GE(corner, 0);
        ASSERT_LT(corner, mesh.vertices());
      }
      for (const Column& column : mesh.vertexColumns)
      {
        ASSERT_EQ(column.tuples(), static_cast<std::size_t>(mesh.vertices()));
      }
      for (const Column& column : mesh.cellColumns)
      {
        ASSERT_EQ(column.tuples(), static_cast<std::size_t>(mesh.cells()));
      }
    }
    catch (const Error&)
    {
    }
  };
  Random random(7);
  for (const auto& [name, bytes] : files)
  {
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 60)
    {
      attempt(name, bytes.substr(0, length));
    }
    for (int i = 0; i < 150; ++i)
    {
      std::string damaged = bytes;
      for (int k = 0; k < 1 + i % 4; ++k)
      {
        const auto place =
          static_cast<std::size_t>(random.below(static_cast<std::int64_t>(damaged.size())));
        damaged[place] =
          i % 2 ? static_cast<char>(random.below(256)) : "0123456789-.e \n"[random.below(15)];
      }
      attempt(name, damaged);
    }
  }
}

TEST(ImportData, ArchiveMeshesHaveTheirCounts)
{
  const std::filesystem::path folder = SMG_TEST_DATA_DIR;
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  struct Expected
  {
    const char* file;
    CellType type;
    std::int64_t vertices, cells;
  };
  constexpr Expected expected[] = { { "bunny.ply", CellType::Triangle, 35947, 69451 },
    { "elephant44k.off", CellType::Triangle, 44460, 88928 },
    { "armadillo43k.obj", CellType::Triangle, 43243, 86482 },
    { "dragon.ply", CellType::Triangle, 437645, 871414 },
    { "horse_be.ply", CellType::Triangle, 48485, 96966 },
    { "rangemap_lato315.ply", CellType::Triangle, 62702, 120995 },
    { "bunny_tet.mesh", CellType::Tetrahedron, 5433, 34055 },
    { "armadillo_tet.msh", CellType::Tetrahedron, 13230, 54985 } };
  for (const Expected& each : expected)
  {
    const IndexedMesh mesh = importMesh(folder / each.file);
    EXPECT_EQ(mesh.cellType, each.type) << each.file;
    EXPECT_EQ(mesh.vertices(), each.vertices) << each.file;
    EXPECT_EQ(mesh.cells(), each.cells) << each.file;
  }
}
