// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/Gmsh/GmshFormat.h"
#include "IO/Formats/Medit/MeditFormat.h"
#include "IO/Formats/Obj/ObjFormat.h"
#include "IO/Formats/Off/OffFormat.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Stl/StlFormat.h"
#include "IO/Formats/TetGen/TetGenFormat.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "Testing/IO/ImportFixture.h"

#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace smg::testing
{
namespace
{

class ImportFormat : public ImportFixture
{
protected:
  const Format* format(const std::string& name, std::string_view bytes)
  {
    writeBytes(this->Folder / name, bytes);
    return formatOfFile(this->Folder / name);
  }
};

const std::string TriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string Off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/** The bytes as a gzip file of one member. */
std::string gzip(std::string_view bytes)
{
  constexpr int onlyGzip = 16;
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + onlyGzip, 8, Z_DEFAULT_STRATEGY);
  std::string compressed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  deflate(&stream, Z_FINISH);
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  return compressed;
}

} // namespace

TEST_F(ImportFormat, IsKnownByContentWhateverTheSuffix)
{
  const std::pair<const char*, const Format*> files[] = { { "ply\nformat", &PlyFormat },
    { "ply\r\nformat", &PlyFormat }, { "OFF\n", &OffFormat },
    { "# a comment\nCNOFF 3 1 0", &OffFormat }, { "OFF# comment\n", &OffFormat },
    { "STCN4nOFF\n", &OffFormat }, { "# vtk DataFile Version 5.1\n", &LegacyVtkFormat },
    { "<VTKFile type=\"PolyData\">", &VtkXmlFormat },
    { "<?xml version=\"1.0\"?>\n<VTKFile version='1.0' type='PUnstructuredGrid'>",
      &ParallelVtkXmlFormat },
    { "<VTKFile type=\"PPolyData\">", &ParallelVtkXmlFormat },
    { "$MeshFormat\n4.1 0 8\n", &GmshFormat },
    { "# comment\n\n MeshVersionFormatted 2\n", &MeditFormat },
    { "solid x\n facet normal 0 0 1\n", &StlFormat }, { "solid\nendsolid\n", &StlFormat },
    { "# c\n\nmtllib a.mtl\nv 0 0 0\n", &ObjFormat },
    { "g a \\\n b\nvn 0 0 1\nv 1 1 1", &ObjFormat } };
  for (const auto& [content, format] : files)
  {
    for (const char* name : { "noSuffix", "a.xyz", "a.ply", "a.OBJ", "a.stl", "a.msh", "a.node" })
    {
      EXPECT_EQ(this->format(name, content), format) << name << ": " << content;
    }
  }
}

TEST_F(ImportFormat, LongContentIsToldByItsBeginning)
{
  std::string obj = "# header\n";
  while (obj.size() < 20000)
  {
    obj += TriangleObj;
  }
  EXPECT_EQ(this->format("a", obj), &ObjFormat);
  EXPECT_EQ(this->format("a", obj.replace(1000, 9, "\nnot obj\n")), nullptr);
  std::string stl(84 + 50 * 1000, 'x');
  const std::uint32_t triangles = 1000;
  std::memcpy(stl.data() + 80, &triangles, sizeof(triangles));
  EXPECT_EQ(this->format("a.ply", stl), &StlFormat);
  EXPECT_EQ(this->format("a", stl + 'x'), nullptr);
}

TEST_F(ImportFormat, IsKnownBySuffixWhereContentSaysNothing)
{
  const std::pair<const char*, const Format*> files[] = { { "a.node", &TetGenFormat },
    { "a.ELE", &TetGenFormat }, { "a.off", &OffFormat }, { "a.mesh", &MeditFormat },
    { "a.pvtu", &ParallelVtkXmlFormat }, { "a.xyz", nullptr }, { "a", nullptr } };
  for (const auto& [name, format] : files)
  {
    EXPECT_EQ(this->format(name, "3 1 0\n"), format) << name;
    EXPECT_EQ(this->format(name + std::string(".gz"), gzip("3 1 0\n")), format) << name;
  }
  EXPECT_EQ(formatOfFile(this->Folder / "missing.off"), &OffFormat);
}

TEST_F(ImportFormat, ContentAloneIsSureOfWhatHasASign)
{
  this->format("a", Off);
  EXPECT_EQ(formatOfContent(this->Folder / "a"), &OffFormat);
  this->format("a", gzip(Off));
  EXPECT_EQ(formatOfContent(this->Folder / "a"), &OffFormat);
  // A streaming format in text looks the same.
  this->format("a.obj", TriangleObj);
  EXPECT_EQ(formatOfContent(this->Folder / "a.obj"), nullptr);
  EXPECT_EQ(formatOfContent(this->Folder / "missing"), nullptr);
}

TEST_F(ImportFormat, MeshesAreReadWhateverTheSuffix)
{
  for (const char* name : { "a", "a.ply", "a.vtu", "a.stl.gz" })
  {
    EXPECT_EQ(this->read(name, Off).corners, (Numbers{ 0, 1, 2 })) << name;
    EXPECT_EQ(this->read(name, TriangleObj).corners, (Numbers{ 0, 1, 2 })) << name;
  }
  EXPECT_EQ(this->read("a.off", Off.substr(4)).corners, (Numbers{ 0, 1, 2 }));
}

TEST_F(ImportFormat, WhatIsNoMeshIsRefused)
{
  std::string garbage;
  Random random(5);
  for (int i = 0; i < 300000; ++i)
  {
    garbage += static_cast<char>(random.below(256));
  }
  this->expectError("a.xyz", garbage, "the format is not known");
  this->expectError("a", "1 2 3", "the format is not known");
  this->expectError("a.txt", "v is a letter\nthe text goes on\n", "the format is not known");
  this->expectError("a.ply", "", "empty");
  for (const char* name : { "a.ply", "a.obj", "a.off", "a.stl" })
  {
    this->expectError(name, garbage, ": ");
    this->expectError(name, "This is a text, and no mesh.\n", ": ");
  }
  Workspace workspace({}, Workspace::MinMemory);
  smg::testing::expectError(
    [&] { importMesh(this->Folder / "missing.ply", workspace); }, "missing.ply: cannot be opened");
  smg::testing::expectError(
    [&] { importMesh(this->Folder.path(), workspace); }, "not a regular file");
}

TEST_F(ImportFormat, CompressedFilesAreTheSame)
{
  const IndexedTestMesh mesh = torus(150, 150, 0.1);
  const std::string text = meshText(mesh);
  ASSERT_GT(text.size(), InputFile::WindowBytes);
  const std::string half = text.substr(0, text.size() / 2);
  const std::string members = gzip(half) + gzip("") + gzip(text.substr(half.size()));
  for (const std::string& bytes : { gzip(text), members, members + std::string(600, '\0') })
  {
    const ReadMesh read = this->read("a.off.gz", bytes);
    EXPECT_TRUE(read.positions == mesh.positions);
    EXPECT_TRUE(read.corners == mesh.corners);
  }
}

TEST_F(ImportFormat, NothingOfACompressedFileStays)
{
  writeBytes(this->Folder / "a.gz", gzip(Off));
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  const auto files = [&workspace]
  { return std::distance(std::filesystem::directory_iterator(workspace.folder()), {}); };
  const std::ptrdiff_t before = files();
  importMesh(this->Folder / "a.gz", workspace);
  EXPECT_EQ(files(), before);
  for (const std::string& bytes : { gzip("no mesh"), gzip(Off) + "more", gzip(Off).substr(0, 30) })
  {
    writeBytes(this->Folder / "a.gz", bytes);
    EXPECT_THROW(importMesh(this->Folder / "a.gz", workspace), Error);
    EXPECT_EQ(files(), before);
  }
}

TEST_F(ImportFormat, DamageOfCompressedFilesIsFound)
{
  const std::string bytes = gzip(Off);
  for (std::size_t length = 2; length < bytes.size(); ++length)
  {
    this->expectError("a.off.gz", bytes.substr(0, length), "truncated");
  }
  std::string checksum = bytes;
  checksum[checksum.size() - 6] ^= 1;
  this->expectError("a.off.gz", checksum, "the compressed data are damaged");
  this->expectError("a.off.gz", bytes + "more", "something comes after the compressed data");
  this->expectError("a.off.gz", bytes + bytes.substr(0, 12), "truncated");
  this->expectError("a.off.gz", gzip(""), "the file is empty");
  // Errors of the parser name the file, not a scratch file.
  this->expectError(
    "a.off.gz", gzip("OFF\n1 0 0\n0 0 x\n"), "a.off.gz, line 3: 'x' is not a number");
  this->expectError("a.gz", gzip("1 2 3"), "a.gz: the format is not known");
  this->expectDamageIsFound("b.off.gz", bytes);
}

TEST_F(ImportFormat, FilesBesideACompressedFileAreFound)
{
  const std::string nodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const std::string elements = "1 4 0\n1 1 2 3 4\n";
  const Numbers corners{ 0, 1, 2, 3 };
  writeBytes(this->Folder / "a.ele", elements);
  EXPECT_EQ(this->read("a.node.gz", gzip(nodes)).corners, corners);
  EXPECT_EQ(this->readFile(this->Folder / "a.node.gz").corners, corners);
  this->expectError("b.ele.gz", gzip(elements), "b.node', which has the nodes");
  writeBytes(this->Folder / "b.node.gz", gzip(nodes));
  EXPECT_EQ(this->readFile(this->Folder / "b.ele.gz").corners, corners);

  writeBytes(this->Folder / "piece.vtp",
    "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points>"
    "<DataArray type=\"Float32\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
    "<DataArray type=\"Int32\" Name=\"connectivity\">0 1 2</DataArray>"
    "<DataArray type=\"Int32\" "
    "Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>");
  const std::string parallel =
    "<VTKFile type=\"PPolyData\"><PPolyData><Piece Source=\"piece.vtp\"/>"
    "</PPolyData></VTKFile>";
  EXPECT_EQ(this->read("a.pvtp.gz", gzip(parallel)).cells(), 1);
}

TEST_F(ImportFormat, ProgressGrowsToItsEnd)
{
  const std::string text = meshText(torus(200, 200, 0.1));
  for (const std::string& bytes : { text, gzip(text) })
  {
    writeBytes(this->Folder / "a.off", bytes);
    std::vector<double> done;
    ImportOptions options;
    options.progress = [&done](double fraction)
    {
      done.push_back(fraction);
      return true;
    };
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    importMesh(this->Folder / "a.off", workspace, options);
    ASSERT_GE(done.size(), 3u);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    EXPECT_LE(done.back(), 1.0);
    EXPECT_GT(done.back(), 0.3);
  }
}

TEST_F(ImportFormat, CancelEndsIt)
{
  const std::string text = meshText(grid(20, 20));
  for (const std::string& bytes : { text, gzip(text) })
  {
    writeBytes(this->Folder / "a.off", bytes);
    ImportOptions options;
    options.progress = [](double) { return false; };
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    EXPECT_THROW(importMesh(this->Folder / "a.off", workspace, options), Cancelled);
  }
}

} // namespace smg::testing
