// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/FormatSuffixes.h"
#include "smg/Convert.h"

#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
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

/** The bytes as a file of xz, with a dictionary of this size. */
std::string xzWith(std::string_view bytes, std::uint32_t dictionary)
{
  lzma_options_lzma options;
  lzma_lzma_preset(&options, 0);
  options.dict_size = dictionary;
  const lzma_filter filters[] = { { LZMA_FILTER_LZMA2, &options }, { LZMA_VLI_UNKNOWN, nullptr } };
  std::string compressed(lzma_stream_buffer_bound(bytes.size()), '\0');
  std::size_t size = 0;
  const lzma_ret result = lzma_stream_buffer_encode(const_cast<lzma_filter*>(filters),
    LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
    reinterpret_cast<std::uint8_t*>(compressed.data()), &size, compressed.size());
  EXPECT_EQ(result, LZMA_OK);
  compressed.resize(size);
  return compressed;
}

std::string xz(std::string_view bytes)
{
  return xzWith(bytes, std::uint32_t(1) << 20);
}

/** The bytes as a file of zstd, whose frame does not tell their number but a window; 0: it tells
 * the number. */
std::string zstdWith(std::string_view bytes, int windowLog)
{
  std::string compressed(ZSTD_compressBound(bytes.size()), '\0');
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  ZSTD_CCtx_setParameter(context, ZSTD_c_windowLog, windowLog);
  ZSTD_inBuffer in{ bytes.data(), bytes.size(), 0 };
  ZSTD_outBuffer out{ compressed.data(), compressed.size(), 0 };
  if (windowLog > 0)
  {
    // In two calls, so that the number is not known at the beginning.
    ZSTD_compressStream2(context, &out, &in, ZSTD_e_continue);
    ZSTD_compressStream2(context, &out, &in, ZSTD_e_flush);
  }
  EXPECT_EQ(ZSTD_compressStream2(context, &out, &in, ZSTD_e_end), 0U);
  compressed.resize(out.pos);
  ZSTD_freeCCtx(context);
  return compressed;
}

std::string zstd(std::string_view bytes)
{
  return zstdWith(bytes, 0);
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

TEST_F(ImportFormat, LinesOfTextMayEndWithCarriageReturns)
{
  const std::pair<const char*, std::string> files[] = {
    { "a.ply",
      "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" },
    { "a.off", "# c\n" + Off }, { "a.obj", "# c\n" + TriangleObj },
    { "a.stl", "# c\nsolid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
               "vertex 0 1 0\nendloop\nendfacet\nendsolid x\n" },
    { "a.vtk", "# vtk DataFile Version 3.0\na title\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
               "0 0 0\n1 0 0\n0 1 0\nPOLYGONS 1 4\n3 0 1 2\n" },
    { "a.mesh", "MeshVersionFormatted 2\n# c\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n"
                "0 1 0 0\nTriangles\n1\n1 2 3 0\nEnd\n" },
    { "a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nc\n$EndComments\n$Nodes\n3\n"
               "1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 0 1 1 2 3\n"
               "$EndElements\n" }
  };
  for (const auto& [name, text] : files)
  {
    for (const char* end : { "\n", "\r\n", "\r", "\r\r\n" })
    {
      std::string ended;
      for (const char c : text)
      {
        c == '\n' ? ended += end : ended += c;
      }
      for (const std::string& path : { std::string(name), "b" + lowerSuffix(name) })
      {
        const ReadMesh mesh = this->read(path, ended);
        EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 })) << path;
        EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 })) << path;
      }
    }
  }
  // A carriage return alone within a line ends none, as a blank.
  for (const auto& [name, text] : files)
  {
    const std::size_t comment = text.find("c\n");
    if (comment != std::string::npos && text.find("$MeshFormat") == std::string::npos)
    {
      std::string strayed = text;
      strayed.replace(comment, 1, "c\r c");
      EXPECT_EQ(this->read(name, strayed).corners, (Numbers{ 0, 1, 2 })) << name;
    }
  }
  EXPECT_EQ(this->read("a.obj", "# made by\r foo\n" + TriangleObj).cells(), 1);
  EXPECT_EQ(this->read("a.off", "# made by\r foo\n" + Off).cells(), 1);
  this->expectError(
    "a.off", "OFF\r3 1 0\r0 0 x\r1 0 0\r0 1 0\r3 0 1 2\r", "line 3: 'x' is not a number");
}

TEST_F(ImportFormat, OtherFilesAreRefusedByName)
{
  using namespace std::string_view_literals;
  const std::pair<std::string, const char*> others[] = {
    { "<!DOCTYPE html>\n<html>\n", "begins with '<!DOCTYPE html>', as a web page does" },
    { " <HTML><body>", "as a web page does" },
    { "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12\n",
      "begins with 'version https://git-lfs.github.com/spec/v1', as a pointer of Git LFS does" },
    { "MFEM NURBS mesh v1.0\n",
      "begins with 'MFEM NURBS mesh v1.0', as a mesh of MFEM of another" },
    { "PK\x03\x04\x14 and more", "as a ZIP archive does: unpack it first" },
    { std::string("\xff\xfeO\0F\0F\0\n\0"sv), "as text in UTF-16 does: save it as UTF-8" }
  };
  const auto isParsed = [](auto& format, auto&) { return format.parse; };
  for (const auto& [bytes, part] : others)
  {
    for (const std::string& suffix : suffixesWhere(isParsed))
    {
      this->expectError("a" + suffix, bytes, "is not a");
      this->expectError("a" + suffix, bytes, part);
      // Counts of a header, which an estimate needs, come after that.
      smg::testing::expectError(
        [&] { estimateConversion(this->Folder / ("a" + suffix), ConversionOptions()); }, part);
    }
    this->expectError("a.xyz", bytes, "is not a mesh that is read: it begins with");
  }
  for (const char* name : { "a.ply", "a.vtk", "a.vtu" })
  {
    this->expectError(name, "hello\nworld\n", "file: it begins with 'hello'.");
  }
  this->expectError(
    "a.pvtp", "hello\nworld\n", "a.pvtp: is not a VTK XML file in pieces: it begins with 'hello'.");
  this->expectError("a.ply", "; FBX 7.3.0 project file\n", "as an FBX scene does");
}

TEST_F(ImportFormat, AForeignFileBesideTheNamedOneIsRefusedByName)
{
  const std::string page = "<html>\n", nodes = "1 3 0 0\n1 0 0 0\n",
                    elements = "1 4 0\n1 1 1 1 1\n";
  const std::string part = "is not a TetGen file: it begins with '<html>', as a web page does";
  for (const std::string& other : { page, gzip(page) })
  {
    const std::string suffix = other == page ? "" : ".gz";
    writeBytes(this->Folder / ("a.node" + suffix), other);
    EXPECT_NE(
      this->errorOf("a.ele", elements).find("a.node" + suffix + ": " + part), std::string::npos);
    std::filesystem::remove(this->Folder / ("a.node" + suffix));
    writeBytes(this->Folder / ("b.ele" + suffix), other);
    EXPECT_NE(
      this->errorOf("b.node", nodes).find("b.ele" + suffix + ": " + part), std::string::npos);
    std::filesystem::remove(this->Folder / ("b.ele" + suffix));
  }
}

// The signature of XML may come after what is read to know a format.
TEST_F(ImportFormat, LongCommentsBeforeXmlAreRead)
{
  const std::string tail =
    "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points>"
    "<DataArray type=\"Float32\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
    "<DataArray type=\"Int32\" Name=\"connectivity\">0 1 2</DataArray>"
    "<DataArray type=\"Int32\" "
    "Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>";
  writeBytes(this->Folder / "piece.vtp", tail);
  const std::string parallel =
    "<VTKFile type=\"PPolyData\"><PPolyData><Piece Source=\"piece.vtp\"/></PPolyData></VTKFile>";
  const auto commented = [](std::size_t bytes, const std::string& rest)
  { return "<?xml version=\"1.0\"?>\n<!--" + std::string(bytes, 'c') + "-->\n" + rest; };
  // Also where the first bytes end within the tag.
  for (std::size_t bytes = 4000; bytes < 4120; bytes += 3)
  {
    EXPECT_EQ(this->read("a.vtp", commented(bytes, tail)).cells(), 1) << bytes;
    EXPECT_EQ(this->read("a.pvtp", commented(bytes, parallel)).cells(), 1) << bytes;
  }
  EXPECT_EQ(this->read("a.vtp", commented(20000, tail)).cells(), 1);
  EXPECT_EQ(this->read("a.vtp.gz", gzip(commented(20000, tail))).cells(), 1);
  this->expectError("a.vtp", commented(5000, "<other/>"), "a.vtp");
}

TEST_F(ImportFormat, NumbersOfMicrosoftThatAreNotFiniteAreAttributes)
{
  const auto ply = [](const std::string& z, const std::string& q)
  {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nproperty float q\nelement face 1\nproperty list uchar int "
           "vertex_indices\nend_header\n0 0 " +
           z + " 1\n1 0 0 " + q + "\n0 1 0 3\n3 0 1 2\n";
  };
  const auto vtk = [](const std::string& z, const std::string& q)
  {
    return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 " + z +
           "\n1 0 0\n0 1 0\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nSCALARS q float\n"
           "LOOKUP_TABLE default\n1 " +
           q + " 3\n";
  };
  for (const char* nan : { "1.#QNAN", "-1.#IND", "1.#QNAN00", "1.#SNAN", "nan" })
  {
    EXPECT_TRUE(std::isnan(this->read("a.ply", ply("0", nan)).vertexColumns[0].value(1))) << nan;
    EXPECT_TRUE(std::isnan(this->read("a.vtk", vtk("0", nan)).vertexColumns[0].value(1))) << nan;
    this->expectError("a.ply", ply(nan, "2"), "not finite");
    this->expectError("a.vtk", vtk(nan, "2"), "not finite");
  }
  EXPECT_EQ(this->read("a.ply", ply("0", "-1.#INF")).vertexColumns[0].value(1), -INFINITY);
  EXPECT_EQ(this->read("a.vtk", vtk("0", "1.#INF00")).vertexColumns[0].value(1), INFINITY);
  this->expectError("a.ply", ply("0", "1.#X"), "'1.#X' is not a number");
  this->expectError("a.vtk", vtk("0", "1.#X"), "'1.#X' is not a number");
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

TEST_F(ImportFormat, XzAndZstdAreRead)
{
  const IndexedTestMesh mesh = torus(150, 150, 0.1);
  const std::string text = meshText(mesh);
  const std::string half = text.substr(0, text.size() / 2), rest = text.substr(half.size());
  using Pack = std::string (*)(std::string_view);
  const std::pair<Pack, const char*> packs[] = { { xz, ".xz" }, { zstd, ".zst" } };
  for (const auto& [pack, suffix] : packs)
  {
    const std::string name = std::string("a.off") + suffix;
    for (const std::string& bytes : { pack(text), pack(half) + pack(rest) })
    {
      const ReadMesh read = this->read(name, bytes);
      EXPECT_TRUE(read.positions == mesh.positions);
      EXPECT_TRUE(read.corners == mesh.corners);
    }
    // Without a sign, by the name before compression; by content, whatever the name.
    EXPECT_EQ(this->read(name, pack(Off.substr(4))).cells(), 1);
    EXPECT_EQ(this->read("b", pack(TriangleObj)).cells(), 1);
    const std::string bytes = pack(Off);
    this->expectError(name, bytes.substr(0, bytes.size() - 1), "truncated");
    this->expectError(name, bytes + "more", "something comes after the compressed data");
    this->expectDamageIsFound(name, bytes, 100);
  }
}

TEST_F(ImportFormat, DecompressionTakesMemoryFromTheLimit)
{
  constexpr std::int64_t Mebibyte = std::int64_t(1) << 20;
  struct Case
  {
    std::string name, bytes;
    std::int64_t window; ///< MiB
  };
  std::vector<Case> cases;
  for (const std::int64_t window : { 8, 64, 256 })
  {
    cases.push_back({ "a.off.xz", xzWith(Off, static_cast<std::uint32_t>(window << 20)), window });
    cases.push_back(
      { "a.off.zst", zstdWith(Off, 20 + std::countr_zero(std::uint64_t(window))), window });
  }
  for (const auto& [name, bytes, window] : cases)
  {
    for (const std::int64_t memory : { 16, 80, 320 })
    {
      const std::string what =
        name + ' ' + std::to_string(window) + " in " + std::to_string(memory);
      writeBytes(this->Folder / name, bytes);
      Workspace workspace(this->Folder.path(), memory * Mebibyte);
      const std::string error = messageOf([&] { importMesh(this->Folder / name, workspace); });
      if (window < memory)
      {
        EXPECT_EQ(error, "") << what;
        EXPECT_GE(workspace.pool().peak(), window * Mebibyte) << what;
        EXPECT_LE(workspace.pool().peak(), memory * Mebibyte) << what;
        continue;
      }
      EXPECT_NE(
        error.find("decompressing needs " + std::to_string(window + 1) + " MiB"), std::string::npos)
        << what << ": " << error;
      EXPECT_NE(
        error.find("the limit leaves " + std::to_string(memory) + " MiB"), std::string::npos)
        << what << ": " << error;
    }
  }
}

TEST_F(ImportFormat, PaddingAndSkippableFramesAreRead)
{
  using namespace std::string_view_literals;
  const std::string half = Off.substr(0, 9), rest = Off.substr(9);
  // As pzstd and the seekable format write them; each of the 16 numbers, also without content.
  const std::string skipped("\x50\x2a\x4d\x18\x04\0\0\0abcd"sv),
    empty("\x5f\x2a\x4d\x18\0\0\0\0"sv);
  for (const std::string& bytes : { skipped + zstd(Off), zstd(Off) + empty,
         skipped + zstd(half) + skipped + empty + zstd(rest) + skipped })
  {
    EXPECT_EQ(this->read("a.off.zst", bytes).cells(), 1);
    EXPECT_EQ(this->read("b", bytes).cells(), 1);
  }
  this->expectError("a.off.zst", zstd(Off) + skipped.substr(0, 10), "truncated");
  for (const std::size_t zeros : { 0, 4, 8, 1 << 20 })
  {
    const std::string padding(zeros, '\0');
    EXPECT_EQ(this->read("a.off.xz", xz(half) + padding + xz(rest) + padding).cells(), 1) << zeros;
  }
  for (const std::string& between : { std::string(3, '\0'), std::string(5, '\0') })
  {
    this->expectError("a.off.xz", xz(half) + between + xz(rest), "something comes after");
  }
  this->expectError("a.off.gz", gzip(half) + std::string(4, '\0') + gzip(rest), "something comes");
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
