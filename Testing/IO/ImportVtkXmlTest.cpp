// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Testing/IO/LookOfParser.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/VtkXmlWriter.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

class ImportVtkXml : public ::testing::Test
{
protected:
  ReadMesh read(const std::string& bytes, std::int64_t memory = Workspace::MinMemory)
  {
    writeBytes(this->Path, bytes);
    Workspace workspace(this->Folder.path(), memory);
    RawMeshBuilder builder(workspace, CellChoice::Only);
    InputFile file(this->Path);
    VtkXmlFormat.parse(file, builder, {}, {});
    const RawMesh mesh = builder.finish();
    expectLook(this->Path, CellChoice::Only, VtkXmlFormat, mesh);
    return readRaw(mesh);
  }

  /** Whether the file is refused while it is parsed, or because it holds no mesh. */
  bool isRefused(const std::string& bytes)
  {
    try
    {
      return !messageOf([&] { this->read(bytes); }).empty();
    }
    catch (const MeshError&)
    {
      return true;
    }
  }

  ReadMesh readParallel(const std::string& bytes)
  {
    writeBytes(this->Folder / "all.pvtu", bytes);
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    RawMeshBuilder builder(workspace, CellChoice::Only);
    InputFile file(this->Folder / "all.pvtu");
    ParallelVtkXmlFormat.parse(file, builder, {}, {});
    return readRaw(builder.finish());
  }

  TemporaryFolder Folder;
  std::filesystem::path Path = Folder / "a.vtu";
};

const std::vector<double> FivePoints{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5 };

/** Two tetrahedra with attributes, the arrays in an unusual order. */
std::string tetrahedra(VtkXmlWriter writer)
{
  std::string piece = "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<Cells>\n";
  piece += writer.array("types", "UInt8", std::vector<std::uint8_t>{ 10, 10 });
  piece +=
    writer.array("connectivity", "Int32", std::vector<std::int32_t>{ 0, 1, 2, 3, 1, 2, 3, 4 });
  piece += writer.array("offsets", "Int64", std::vector<std::int64_t>{ 4, 8 });
  piece += "</Cells>\n<PointData Normals=\"out\">\n";
  piece += writer.array("out", "Float32", std::vector<float>(15, 0.5f), 3);
  piece += writer.array("a &lt; b", "UInt16", std::vector<std::uint16_t>{ 1, 2, 3, 4, 65535 });
  piece += "<Array type=\"String\" Name=\"s\" format=\"ascii\">48 0 49 0</Array></PointData>\n";
  piece += "<CellData>\n" + writer.array("c", "Int8", std::vector<std::int8_t>{ -1, 2 });
  piece += "</CellData>\n<Points>\n" + writer.array("Points", "Float64", FivePoints, 3);
  return writer.file("UnstructuredGrid", piece + "</Points>\n</Piece>\n");
}

/** A piece of one triangle with two points on the x-axis from `x` on, and one above. */
std::string trianglePiece(
  VtkXmlWriter& writer, double x, const std::string& pointData, const std::string& cellData)
{
  return "<Piece NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfPolys=\"1\">\n<PointData>" +
         pointData + "</PointData>\n<CellData>" + cellData + "</CellData>\n<Points>" +
         writer.array(
           "Points", "Float64", std::vector<double>{ x, 0, 0, x + 1, 0, 0, x, 1, 0 }, 3) +
         "</Points>\n<Verts>" + writer.array("connectivity", "Int32", std::vector<int>{ 2 }) +
         writer.array("offsets", "Int32", std::vector<int>{ 1 }) + "</Verts>\n<Polys>" +
         writer.array("connectivity", "Int32", std::vector<int>{ 0, 1, 2 }) +
         writer.array("offsets", "Int32", std::vector<int>{ 3 }) + "</Polys>\n</Piece>\n";
}

/** A piece of a grid: two triangles on a square whose left edge is at `x`. */
std::string squareFile(int x, const std::vector<int>& ghosts, bool numbers)
{
  VtkXmlWriter writer;
  std::string text = "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<PointData>\n";
  text += numbers ? writer.array("GlobalIds", "Int64",
                      std::vector<int>{ 2 * x, 2 * x + 1, 2 * x + 2, 2 * x + 3 })
                  : "";
  text += writer.array("x", "Int32", std::vector<int>{ x, x, x + 1, x + 1 });
  text += "</PointData>\n<CellData>" + writer.array("vtkGhostType", "UInt8", ghosts) +
          writer.array("n", "Int32", std::vector<int>{ 10 * x, 10 * x + 1 }) + "</CellData>\n";
  const double left = x;
  text += "<Points>" +
          writer.array("Points", "Float64",
            std::vector<double>{ left, 0, 0, left, 1, 0, left + 1, 0, 0, left + 1, 1, 0 }, 3) +
          "</Points>\n<Cells>" +
          writer.array("connectivity", "Int64", std::vector<int>{ 0, 2, 1, 1, 2, 3 }) +
          writer.array("offsets", "Int64", std::vector<int>{ 3, 6 }) +
          writer.array("types", "UInt8", std::vector<int>{ 5, 5 }) + "</Cells>\n</Piece>\n";
  return writer.file("UnstructuredGrid", text);
}

std::string parallel(const std::vector<std::string>& sources)
{
  std::string text = "<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n";
  for (const std::string& source : sources)
  {
    text += "<Piece Source=\"" + source + "\"/>\n";
  }
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

} // namespace

TEST_F(ImportVtkXml, FieldDataAreNoted)
{
  VtkXmlWriter writer;
  const std::string fields =
    "<FieldData>\n" + writer.array("TimeValue", "Float64", std::vector<double>{ 2.5 }) +
    writer.array("mass", "Float32", std::vector<float>{ 1, 2 }) +
    "<Array type=\"String\" Name=\"author\" format=\"ascii\">109 101 0</Array>\n"
    "<Array type=\"String\" Name=\"Report\" format=\"ascii\">0</Array>\n"
    "</FieldData>\n";
  const ReadMesh mesh =
    this->read(writer.file("PolyData", fields + trianglePiece(writer, 0.0, "", "")));
  EXPECT_EQ(mesh.counts.notes,
    (std::vector<std::string>{
      "Field data are left out, since a mesh has no place for them: 'author', 'mass'." }));
}

TEST_F(ImportVtkXml, AllWaysOfWritingAreTheSameMesh)
{
  for (const Way way : { Way::Ascii, Way::Inline, Way::AppendedBase64, Way::AppendedRaw })
  {
    for (const char* compressor :
      { "", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor" })
    {
      for (const int flags : { 0, 1, 2, 3 })
      {
        VtkXmlWriter writer;
        writer.way = way;
        writer.compressor = compressor;
        writer.bigEndian = (flags & 1) != 0;
        writer.wideHeader = (flags & 2) != 0;
        const ReadMesh mesh = this->read(tetrahedra(writer));
        ASSERT_EQ(mesh.counts.notes.size(), 1u);
        EXPECT_EQ(mesh.counts.notes[0], "Arrays of texts or bits are left out: 's'.");
        EXPECT_EQ(mesh.cellType, CellType::Tetrahedron);
        EXPECT_TRUE(mesh.doublePositions);
        EXPECT_EQ(mesh.positions, FivePoints);
        EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
        ASSERT_EQ(mesh.vertexColumns.size(), 2u);
        EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Normals", ScalarType::Float32, 3 }));
        EXPECT_EQ(mesh.vertexColumns[0].value(4, 2), 0.5);
        EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "a < b", ScalarType::UInt16, 1 }));
        EXPECT_EQ(mesh.vertexColumns[1].value(4), 65535);
        ASSERT_EQ(mesh.elementColumns.size(), 1u);
        EXPECT_EQ(mesh.elementColumns[0].value(0), -1);
      }
    }
  }
}

TEST_F(ImportVtkXml, PiecesFollowEachOtherAsVtkNumbersThem)
{
  VtkXmlWriter writer;
  writer.way = Way::AppendedRaw;
  std::string pieces;
  for (const int x : { 0, 1, 2 })
  {
    pieces += trianglePiece(writer, x, "",
      writer.array("n", "Int32", std::vector<int>{ x, 10 + x }) +
        (x < 2 ? writer.array("some", "Int32", std::vector<int>{ 0, 0 }) : ""));
  }
  const ReadMesh mesh = this->read(writer.file("PolyData", pieces));
  EXPECT_EQ(mesh.vertices(), 9);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 4, 5, 6, 7, 8 }));
  // The points of all pieces are the first elements.
  EXPECT_EQ(mesh.elements, (std::vector<std::int64_t>{ 3, 4, 5 }));
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_EQ(mesh.elementColumns[0].value(i), i < 3 ? i : 7 + i);
  }
  ASSERT_EQ(mesh.counts.notes.size(), 2u);
  EXPECT_NE(mesh.counts.notes[0].find("no global numbers"), std::string::npos);
  EXPECT_NE(mesh.counts.notes[1].find("'some'"), std::string::npos);
}

TEST_F(ImportVtkXml, PiecesTakeOnlyTheMemoryThatIsAllowed)
{
  VtkXmlWriter writer;
  const auto pieces = [](int count)
  {
    std::string text;
    for (int i = 0; i < count; ++i)
    {
      text += "<Piece/>";
    }
    return text;
  };
  const std::string one = trianglePiece(writer, 0, "", "");
  EXPECT_EQ(this->read(writer.file("PolyData", one + pieces(100))).cells(), 1);
  expectError([&] { this->read(writer.file("PolyData", one + pieces(100000))); },
    "more pieces and arrays than fit into the memory");
}

TEST_F(ImportVtkXml, OfSeveralTimeStepsTheFirstOneIsTaken)
{
  VtkXmlWriter writer;
  std::string piece = trianglePiece(writer, 0, "", "");
  const std::string end = "</Polys>";
  piece.insert(piece.find(end), writer.array("connectivity", "Int32", std::vector<int>{ 2, 1, 0 }) +
                                  writer.array("offsets", "Int32", std::vector<int>{ 2 }));
  EXPECT_EQ(
    this->read(writer.file("PolyData", piece)).corners, (std::vector<std::int64_t>{ 0, 1, 2 }));
}

TEST_F(ImportVtkXml, GlobalNumbersAreSingleNumbers)
{
  VtkXmlWriter writer;
  std::string pieces;
  for (const int x : { 0, 1 })
  {
    pieces +=
      trianglePiece(writer, x, writer.array("GlobalIds", "Int64", std::vector<int>(9, x), 3), "");
  }
  EXPECT_EQ(this->read(writer.file("PolyData", pieces)).vertices(), 6);
}

TEST_F(ImportVtkXml, PointsWithTheSameGlobalNumberAreOne)
{
  VtkXmlWriter writer;
  std::string pieces;
  for (const int x : { 0, 1, 2 })
  {
    // The right point of a triangle is the left one of the next.
    pieces += trianglePiece(writer, x,
      writer.array("GlobalIds", "Int64", std::vector<int>{ 2 * x, 2 * x + 2, 2 * x + 1 }) +
        writer.array("v", "Int32", std::vector<int>{ 10 * x, 10 * x + 1, 10 * x + 2 }),
      "");
  }
  const ReadMesh mesh = this->read(writer.file("PolyData", pieces));
  EXPECT_EQ(mesh.vertices(), 7);
  EXPECT_EQ(mesh.counts.mergedPoints, 2);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 1, 3, 4, 3, 5, 6 }));
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  const std::vector<double> values{ 0, 1, 2, 11, 12, 21, 22 };
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(mesh.vertexColumns[0].value(i), values[i]);
  }
}

TEST_F(ImportVtkXml, GhostsOfParallelFilesAreLeftOut)
{
  for (const bool numbers : { true, false })
  {
    writeBytes(this->Folder / "0.vtu", squareFile(0, { 0, 0 }, numbers));
    writeBytes(this->Folder / "1.vtu", squareFile(1, { 1, 0 }, numbers));
    const ReadMesh mesh = this->readParallel(parallel({ "0.vtu", "1.vtu" }));
    EXPECT_EQ(mesh.vertices(), numbers ? 6 : 8);
    EXPECT_EQ(mesh.cells(), 3);
    EXPECT_EQ(mesh.elementCount, 3);
    const std::vector<std::int64_t> last{ mesh.corners.end() - 3, mesh.corners.end() };
    EXPECT_EQ(last,
      numbers ? (std::vector<std::int64_t>{ 3, 4, 5 }) : (std::vector<std::int64_t>{ 5, 6, 7 }));
    ASSERT_EQ(mesh.elementColumns.size(), 1u);
    EXPECT_EQ(mesh.elementColumns[0].value(2), 11);
    EXPECT_EQ(mesh.counts.notes.size(), numbers ? 0u : 1u);
  }
}

TEST_F(ImportVtkXml, GhostsOfALoneFileAreLeftOutWithANote)
{
  const std::pair<int, std::int64_t> types[] = { { 0, 2 }, { 1, 1 }, { 2, 2 }, { 8, 1 }, { 16, 2 },
    { 32, 1 }, { 33, 1 } };
  for (const auto& [type, cells] : types)
  {
    const ReadMesh mesh = this->read(squareFile(0, { type, 0 }, false));
    EXPECT_EQ(mesh.cells(), cells) << type;
    EXPECT_EQ(mesh.elementCount, cells);
    EXPECT_EQ(mesh.elementColumns[0].value(cells - 1), 1);
    EXPECT_EQ(mesh.counts.notes.size(), cells == 2 ? 0u : 1u) << type;
  }
}

TEST_F(ImportVtkXml, NamesMayHaveAnyCharacter)
{
  const std::pair<const char*, const char*> names[] = { { "&#228;", "\u00e4" },
    { "&#xe4;&#8364;", "\u00e4\u20ac" }, { "&#x1F600;", "\U0001F600" }, { "&amp;#228;", "&#228;" },
    { "&#65;&lt;", "A<" }, { "&#xD800;", "&#xD800;" }, { "&#1114112;", "&#1114112;" },
    { "&#99999999999;", "&#99999999999;" }, { "&#6x;", "&#6x;" }, { "&nbsp;", "&nbsp;" },
    { "\u00e4", "\u00e4" } };
  VtkXmlWriter writer;
  for (const auto& [name, plain] : names)
  {
    const std::string data = writer.array(name, "Int32", std::vector<int>{ 1, 2, 3 });
    const ReadMesh mesh = this->read(writer.file("PolyData", trianglePiece(writer, 0, data, "")));
    ASSERT_EQ(mesh.vertexColumns.size(), 1u);
    EXPECT_EQ(mesh.vertexColumns[0].spec.name, plain);
  }
}

TEST_F(ImportVtkXml, ArraysOfOneNameAreAllKept)
{
  VtkXmlWriter writer;
  std::string pieces;
  for (const int x : { 0, 1 })
  {
    std::string data;
    for (const char* name : { "a", "a_1", "a", "a" })
    {
      const int first = 10 * static_cast<int>(data.size()) + x;
      data += writer.array(name, "Int32", std::vector<int>{ first, first + 1, first + 2 });
    }
    pieces += trianglePiece(writer, x, data, "");
  }
  const ReadMesh mesh = this->read(writer.file("PolyData", pieces));
  ASSERT_EQ(mesh.vertexColumns.size(), 4u);
  const char* const names[] = { "a", "a_1", "a_2", "a_3" };
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(mesh.vertexColumns[i].spec.name, names[i]);
    EXPECT_EQ(mesh.vertexColumns[i].value(3), mesh.vertexColumns[i].value(0) + 1);
    EXPECT_TRUE(i == 0 || mesh.vertexColumns[i].value(0) > mesh.vertexColumns[i - 1].value(0));
  }
  EXPECT_TRUE(std::ranges::any_of(mesh.counts.notes,
    [](const std::string& note) { return note.find("NAME_1: 'a'.") != std::string::npos; }));
}

TEST_F(ImportVtkXml, ManyArraysOfOneNameAreNamedInTime)
{
  VtkArrayNames names;
  std::set<std::string> repeated, all;
  VtkArray array;
  constexpr int Count = 50000; // with time in the square of it: minutes
  for (int i = 0; i < Count; ++i)
  {
    // Also the names of some that are to come.
    array.name = i % 1000 == 0 ? "a_" + std::to_string(2 * i) : "a";
    names.nameApart(array, repeated);
    all.insert(array.name);
    EXPECT_TRUE(names.contains(array.name));
  }
  EXPECT_EQ(std::ssize(all), Count);
  EXPECT_LE(repeated.size(), MaxOtherArrays);
}

TEST_F(ImportVtkXml, AMissingPieceIsNamed)
{
  writeBytes(this->Folder / "0.vtu", squareFile(0, { 0, 0 }, true));
  expectError([this] { this->readParallel(parallel({ "0.vtu", "gone.vtu" })); }, "gone.vtu");
  expectError([this] { this->readParallel(parallel({})); }, "no pieces");
}

TEST_F(ImportVtkXml, PiecesElsewhereAreNotRead)
{
  for (const char* elsewhere : { "/etc/0.vtu", "../0.vtu", "sub/../../0.vtu" })
  {
    expectError(
      [&] { this->readParallel(parallel({ elsewhere })); }, "folder of the file or below");
  }
}

TEST_F(ImportVtkXml, AnUnknownCompressorIsRefusedByName)
{
  VtkXmlWriter writer;
  writer.way = Way::AppendedRaw;
  writer.compressor = "vtkOtherDataCompressor";
  const std::string text = tetrahedra(writer);
  expectError([&] { this->read(text); }, "vtkOtherDataCompressor");
}

TEST_F(ImportVtkXml, WhatIsWrongIsSaidWithItsPlace)
{
  VtkXmlWriter writer;
  const std::string good = tetrahedra(writer);
  const auto with = [&good](const std::string& from, const std::string& to)
  {
    std::string text = good;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  };
  const std::vector<std::pair<std::string, std::string>> wrong{
    { with("0 1 2 3 1 2 3 4", "0 1 2 3 1 2 3 5"), "cell 1: the corner 5" },
    { with("0 1 2 3 1 2 3 4", "0 1 2 3 1 2 3"), "fewer numbers" },
    { with("0 1 2 3 1 2 3 4", "0 1 2 3 1 2 3 4 4"), "more numbers" },
    { with("0 1 2 3 1 2 3 4", "0 1 2 3 1 2 3 4x"), "'4x'" },
    { with("10 10", "10 42"), "its type is polyhedron" },
    { with("4 8", "4 3"), "before it begins" }, { with("4 8", "4 9"), "fewer numbers" },
    { with("4 8", "8 8"), "cannot have" }, { with("1.5", "nan"), "point 4" },
    { with("\"5\"", "\"6\""), "fewer numbers" }, { with("\"5\"", "\"-5\""), "NumberOfPoints" },
    { with("\"5\"", "\"4611686018427387904\""), "NumberOfPoints" },
    { with("\"offsets\"", "\"off\""), "lacks an array" },
    { with("UnstructuredGrid", "ImageData"), "neither" }, { with("ascii", "octal"), "'octal'" },
    { with("ascii", "appended\" offset=\"0"), "appended" }, { with("</VTKFile>", ""), "end" },
    { with("Float64", "Complex"), "'Complex'" },
    { with("NumberOfComponents=\"3\"", "NumberOfComponents=\"0\""), "components" }
  };
  for (const auto& [text, part] : wrong)
  {
    expectError([&] { this->read(text); }, part);
    expectError([&] { this->read(text); }, this->Path.string());
  }
}

TEST_F(ImportVtkXml, TruncatedFilesAreErrors)
{
  Combinations combinations;
  for (const Way way : { Way::Ascii, Way::Inline, Way::AppendedBase64, Way::AppendedRaw })
  {
    for (const char* compressor : { "", "vtkZLibDataCompressor" })
    {
      VtkXmlWriter writer;
      writer.way = way;
      writer.compressor = compressor;
      const std::string whole = tetrahedra(writer);
      const std::size_t dataEnd =
        whole.rfind(way < Way::AppendedBase64 ? "\n</DataArray>" : "\n</AppendedData>");
      for (std::size_t size = 1; size + 4 < whole.size(); size += 19)
      {
        if (!combinations.next())
        {
          continue;
        }
        EXPECT_TRUE(this->isRefused(whole.substr(0, size))) << size;
        // Bytes are missing before the end tag, more than the tag could replace.
        const std::string cut = whole.substr(0, size) + "</VTKFile>\n";
        EXPECT_TRUE(size + 16 >= dataEnd || this->isRefused(cut)) << size;
      }
    }
  }
}

} // namespace smg::testing
