// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Testing/IO/LookOfParser.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** The numbers as the bytes of a binary file, which are big-endian. */
template <class T>
std::string bigEndian(const std::vector<T>& numbers)
{
  std::string bytes;
  for (const T number : numbers)
  {
    std::string own(reinterpret_cast<const char*>(&number), sizeof(T));
    if constexpr (std::endian::native == std::endian::little)
    {
      std::ranges::reverse(own);
    }
    bytes += own;
  }
  return bytes;
}

/** The numbers as text or as bytes. */
template <class T>
std::string written(const std::vector<T>& numbers, bool binary)
{
  if (binary)
  {
    return bigEndian(numbers) + '\n';
  }
  std::string text;
  for (const T number : numbers)
  {
    text += exact(static_cast<double>(number)) + (text.size() % 7 == 0 ? "\n" : " ");
  }
  return text + '\n';
}

std::string head(bool binary, const std::string& version, const std::string& kind)
{
  return "# vtk DataFile Version " + version + "\nby hand\n" + (binary ? "BINARY" : "ASCII") +
         "\nDATASET " + kind + "\n";
}

constexpr const char* Square = "POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n";

class ImportLegacyVtk : public ::testing::Test
{
protected:
  ReadMesh read(const std::string& bytes, CellChoice cells = CellChoice::Only)
  {
    writeBytes(this->Path, bytes);
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    RawMeshBuilder builder(workspace, cells);
    InputFile file(this->Path);
    LegacyVtkFormat.parse(file, builder, {}, {});
    const RawMesh mesh = builder.finish();
    expectLook(this->Path, cells, LegacyVtkFormat, mesh);
    return readRaw(mesh);
  }

  /** A grid of consecutive cells of one type on the given points. */
  ReadMesh readGrid(
    int type, const std::vector<double>& points, const std::vector<std::int64_t>& cell)
  {
    std::vector<std::int64_t> list{ static_cast<std::int64_t>(cell.size()) };
    list.insert(list.end(), cell.begin(), cell.end());
    return this->read(head(false, "3.0", "UNSTRUCTURED_GRID") + "POINTS " +
                      std::to_string(points.size() / 3) + " double\n" + written(points, false) +
                      "CELLS 1 " + std::to_string(list.size()) + "\n" + written(list, false) +
                      "CELL_TYPES 1\n" + std::to_string(type) + "\n");
  }

  TemporaryFolder Folder;
  std::filesystem::path Path = Folder / "a.vtk";
};

/** Two tetrahedra with attributes, in all layouts of the format. */
std::string tetrahedra(bool binary, bool offsets)
{
  const std::vector<float> points{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5f };
  std::string text = head(binary, offsets ? "5.1" : "4.2", "UNSTRUCTURED_GRID") +
                     "POINTS 5 float\n" + written(points, binary);
  if (offsets)
  {
    text += "CELLS 3 8\nOFFSETS vtktypeint64\n" +
            written(std::vector<std::int64_t>{ 0, 4, 8 }, binary) + "CONNECTIVITY vtktypeint64\n" +
            written(std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }, binary);
  }
  else
  {
    text +=
      "CELLS 2 10\n" + written(std::vector<std::int32_t>{ 4, 0, 1, 2, 3, 4, 1, 2, 3, 4 }, binary);
  }
  return text + "CELL_TYPES 2\n" + written(std::vector<std::int32_t>{ 10, 10 }, binary) +
         "POINT_DATA 5\nSCALARS heat%20flow double 1\nLOOKUP_TABLE default\n" +
         written(std::vector<double>{ 1, 2, 3, 4, 0.1 }, binary) + "METADATA\nINFORMATION 0\n\n" +
         "CELL_DATA 2\nFIELD FieldData 2\nwords 1 2 string\n" +
         (binary ? std::string("\xc3one\xc3two\n") : "one\ntwo\n") + "part 2 2 short\n" +
         written(std::vector<std::int16_t>{ 1, -2, 3, 400 }, binary);
}

} // namespace

TEST_F(ImportLegacyVtk, AllLayoutsAreTheSameMesh)
{
  for (const bool binary : { false, true })
  {
    for (const bool offsets : { false, true })
    {
      const ReadMesh mesh = this->read(tetrahedra(binary, offsets));
      EXPECT_EQ(mesh.cellType, CellType::Tetrahedron);
      EXPECT_FALSE(mesh.doublePositions);
      EXPECT_EQ(mesh.vertices(), 5);
      EXPECT_EQ(mesh.positions.back(), 1.5);
      EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
      ASSERT_EQ(mesh.vertexColumns.size(), 1u);
      EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "heat flow", ScalarType::Float64, 1 }));
      EXPECT_EQ(mesh.vertexColumns[0].value(4), 0.1);
      ASSERT_EQ(mesh.elementColumns.size(), 1u);
      EXPECT_EQ(mesh.elementColumns[0].spec, (ColumnSpec{ "part", ScalarType::Int16, 2 }));
      EXPECT_EQ(mesh.elementColumns[0].value(0, 1), -2);
      EXPECT_EQ(mesh.elementColumns[0].value(1, 1), 400);
      ASSERT_EQ(mesh.counts.notes.size(), 1u);
      EXPECT_EQ(mesh.counts.notes[0], "Arrays of texts or bits are left out: 'words'.");
    }
  }
}

TEST_F(ImportLegacyVtk, ElementsAreNumberedAsVtkNumbersCells)
{
  // Strips precede polygons, and both precede the points and lines that VTK numbers first.
  const ReadMesh mesh = this->read(head(false, "3.0", "POLYDATA") + Square +
                                   "TRIANGLE_STRIPS 1 5\n4 0 1 3 2\nPOLYGONS 2 9\n4 0 1 2 3\n"
                                   "3 3 2 1\nLINES 1 4\n3 0 1 2\nVERTICES 2 4\n1 0\n1 1\n"
                                   "CELL_DATA 6\nSCALARS n int\nLOOKUP_TABLE default\n"
                                   "0 1 2 3 4 5\n");
  EXPECT_EQ(
    mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3, 3, 2, 1, 0, 1, 3, 3, 1, 2 }));
  EXPECT_EQ(mesh.elements, (std::vector<std::int64_t>{ 3, 3, 4, 5, 5 }));
  EXPECT_EQ(mesh.elementCount, 6);
  EXPECT_EQ(mesh.counts.droppedCells, 3);
  EXPECT_EQ(mesh.counts.triangulatedPolygons, 2);
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(mesh.elementColumns[0].value(5), 5);
}

TEST_F(ImportLegacyVtk, SolidsFillTheirVolume)
{
  // The unit cube as VTK orders a voxel; a hexahedron, a wedge and a pyramid of its corners.
  const std::vector<double> cube{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1,
    1, 1 };
  struct Solid
  {
    int type;
    std::vector<std::int64_t> corners;
    double volume;
  };
  const std::vector<Solid> solids{ { 11, { 0, 1, 2, 3, 4, 5, 6, 7 }, 1.0 },
    { 12, { 0, 1, 3, 2, 4, 5, 7, 6 }, 1.0 }, { 13, { 0, 2, 1, 4, 6, 5 }, 0.5 },
    { 14, { 0, 1, 3, 2, 4 }, 1.0 / 3.0 }, { 24, { 0, 1, 2, 4, 0, 0, 0, 0, 0, 0 }, 1.0 / 6.0 } };
  for (const auto& [type, corners, volume] : solids)
  {
    const ReadMesh mesh = this->readGrid(type, cube, corners);
    double sum = 0.0;
    for (std::size_t cell = 0; cell < mesh.corners.size(); cell += 4)
    {
      double e[3][3];
      for (int k = 0; k < 9; ++k)
      {
        e[k / 3][k % 3] =
          mesh.positions[static_cast<std::size_t>(mesh.corners[cell + 1 + k / 3] * 3 + k % 3)] -
          mesh.positions[static_cast<std::size_t>(mesh.corners[cell] * 3 + k % 3)];
      }
      const double part = (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                          6.0;
      sum += std::abs(part);
    }
    EXPECT_NEAR(sum, volume, 1e-12) << type;
    EXPECT_EQ(mesh.counts.higherOrderCells, type == 24 ? 1 : 0);
  }
}

TEST_F(ImportLegacyVtk, FlatCellsAreTheirPolygon)
{
  const std::vector<double> square{ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
  const std::vector<std::int64_t> around{ 0, 1, 2, 0, 2, 3 };
  EXPECT_EQ(this->readGrid(9, square, { 0, 1, 2, 3 }).corners, around);
  EXPECT_EQ(this->readGrid(8, square, { 0, 1, 3, 2 }).corners, around);
  EXPECT_EQ(this->readGrid(7, square, { 0, 1, 2, 3 }).corners, around);
  EXPECT_EQ(this->readGrid(23, square, { 0, 1, 2, 3, 0, 0, 0, 0 }).corners, around);
  EXPECT_EQ(this->readGrid(36, square, { 0, 1, 2, 3, 0, 0, 0, 0 }).corners, around);
  EXPECT_EQ(
    this->readGrid(69, square, { 2, 1, 0, 3 }).corners, (std::vector<std::int64_t>{ 2, 1, 0 }));
  EXPECT_EQ(this->readGrid(6, square, { 0, 1, 3, 2 }).corners,
    (std::vector<std::int64_t>{ 0, 1, 3, 3, 1, 2 }));
}

TEST_F(ImportLegacyVtk, CellsThatAreNotWantedAreOnlyDropped)
{
  const ReadMesh mesh = this->read(head(false, "3.0", "UNSTRUCTURED_GRID") + Square +
                                     "CELLS 2 12\n6 0 1 2 0 0 0 4 0 1 2 3\nCELL_TYPES 2\n22 10\n",
    CellChoice::Tetrahedra);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3 }));
  EXPECT_EQ(mesh.counts.droppedCells, 1);
  EXPECT_EQ(mesh.counts.higherOrderCells, 0);
}

TEST_F(ImportLegacyVtk, AttributesOfEveryKind)
{
  const std::string text =
    head(false, "3.0", "POLYDATA") + Square + "POLYGONS 1 5\n4 0 1 2 3\n" +
    "POINT_DATA 4\nSCALARS s unsigned_char 2\nLOOKUP_TABLE table\n1 2 3 4 5 6 7 255\n"
    "LOOKUP_TABLE table 1\n0 0 0 1\nVECTORS v long\n1 2 3 4 5 6 7 8 9 10 11 -12\n"
    "NORMALS out float\n0 0 1 0 0 1 0 0 1 0 0 1\nTEXTURE_COORDINATES t 2 double\n"
    "0 0 0 1 1 0 1 nan\nTENSORS g float\n" +
    written(std::vector<float>(36, 0.5f), false) +
    "COLOR_SCALARS c 3\n0 0.2 1 0 0 0 0 0 0 0 0 0.6\nGLOBAL_IDS gid vtkIdType\n9 8 7 6\n"
    "FIELD FieldData 3\nf%2f1 1 4 float\n1 2 3 4\nb 1 4 bit\n0 1 0 1\nodd 1 3 int\n1 2 3\n";
  const ReadMesh mesh = this->read(text);
  std::vector<ColumnSpec> specs;
  for (const Column& column : mesh.vertexColumns)
  {
    specs.push_back(column.spec);
  }
  EXPECT_EQ(specs,
    (std::vector<ColumnSpec>{ { "s", ScalarType::UInt8, 2 }, { "v", ScalarType::Int64, 3 },
      { "Normals", ScalarType::Float32, 3 }, { "TextureCoordinates", ScalarType::Float64, 2 },
      { "g", ScalarType::Float32, 9 }, { "c", ScalarType::UInt8, 3 },
      { "gid", ScalarType::Int64, 1 }, { "f/1", ScalarType::Float32, 1 } }));
  EXPECT_EQ(mesh.vertexColumns[0].value(3, 1), 255);
  EXPECT_EQ(mesh.vertexColumns[1].value(3, 2), -12);
  EXPECT_TRUE(std::isnan(mesh.vertexColumns[3].value(3, 1)));
  EXPECT_EQ(mesh.vertexColumns[5].value(0, 1), 51);
  EXPECT_EQ(mesh.vertexColumns[5].value(3, 2), 153);
}

TEST_F(ImportLegacyVtk, FieldDataAreNoted)
{
  const std::string fields =
    "FIELD FieldData 4\nTimeValue 1 1 double\n2.5\nmass 1 2 float\n1 2\nPreview 1 1 int\n1\n"
    "author 1 1 string\nme\n";
  const std::string mesh = std::string(Square) + "POLYGONS 1 5\n4 0 1 2 3\n";
  for (const bool first : { true, false })
  {
    std::string text = head(false, "3.0", "POLYDATA");
    text = first ? text.insert(text.find("DATASET"), fields) + mesh : text + fields + mesh;
    EXPECT_EQ(this->read(text).counts.notes,
      (std::vector<std::string>{
        "Field data are left out, since a mesh has no place for them: 'author', 'mass'." }));
  }
}

TEST_F(ImportLegacyVtk, NumbersOfTypeVtkIdTypeAreWrittenInFourBytes)
{
  const std::string text = head(true, "3.0", "POLYDATA") + "POINTS 3 double\n" +
                           bigEndian(std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) +
                           // No line end here: some writers omit it.
                           "POLYGONS 1 4\r\n" + bigEndian(std::vector<std::int32_t>{ 3, 0, 1, 2 }) +
                           "\nPOINT_DATA 3\nSCALARS i vtkIdType\nLOOKUP_TABLE default\n" +
                           bigEndian(std::vector<std::int32_t>{ 5, 6, -7 }) + "\n";
  const ReadMesh mesh = this->read(text);
  EXPECT_TRUE(mesh.doublePositions);
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec.type, ScalarType::Int64);
  EXPECT_EQ(mesh.vertexColumns[0].value(2), -7);
}

TEST_F(ImportLegacyVtk, WhatIsWrongIsSaidWithItsPlace)
{
  const std::string begin = head(false, "3.0", "POLYDATA");
  const std::string triangle = begin + Square + "POLYGONS 1 4\n3 0 1 2\n";
  const std::string grid = head(false, "3.0", "UNSTRUCTURED_GRID") + Square;
  const std::vector<std::pair<std::string, std::string>> wrong{
    { "# vtk DataFile Version x\n\nASCII\n", "version" },
    { head(false, "3.0", "STRUCTURED_POINTS") + "DIMENSIONS 2 2 2\n", "neither" },
    { begin + "POINTS 4000000000000 float\n0 0 0\n", "truncated" },
    { begin + "POINTS -1 float\n", "number of points" },
    { begin + "POINTS 1 quaternion\n0 0 0\n", "type" },
    { begin + "POINTS 1 float\n0 nan 0\nPOLYGONS 1 4\n3 0 0 0\n", "point 0: " },
    { begin + "POINTS 1 float\n0 x 0\nPOLYGONS 1 4\n3 0 0 0\n", "'x' is not a number" },
    { begin + Square + "POLYGONS 1 4\n3 0 1 4\n", "cell 0: the corner 4" },
    { begin + Square + "POLYGONS 1 4\n3 0 1 -1\n", "the corner -1" },
    { begin + Square + "POLYGONS 1 4\n-3 0 1 1\n", "-3 points" },
    { begin + Square + "POLYGONS 1 4\n4 0 1 2\n", "fewer numbers" },
    { begin + Square + "POLYGONS 1 5\n3 0 1 2 3\n", "more numbers" },
    { begin + Square + "POLYGONS 9 4\n3 0 1 2\n", "cannot hold 9 cells" },
    { triangle + "POINT_DATA 3\n", "POINT_DATA" }, { triangle + "CELL_DATA 2\n", "CELL_DATA" },
    { triangle + "POINT_DATA 4\nSCALARS s int\n1 2 3 4\n", "LOOKUP_TABLE" },
    { triangle + "POINT_DATA 4\nSCALARS s short\nLOOKUP_TABLE t\n1 2 3 70000\n", "'70000'" },
    { triangle + "RUBBISH\n", "'RUBBISH'" }, { grid + "CELLS 1 5\n4 0 1 2 3\n", "CELL_TYPES" },
    { grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n42\n", "its type is polyhedron" },
    { grid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n", "cannot have" },
    { head(false, "5.1", "POLYDATA") + Square +
        "POLYGONS 2 3\nOFFSETS vtktypeint64\n1 4\nCONNECTIVITY vtktypeint64\n0 1 2\n",
      "begin with 0" },
    { head(false, "5.1", "POLYDATA") + Square +
        "POLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 2\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2\n",
      "before it begins" }
  };
  for (const auto& [text, part] : wrong)
  {
    expectError([&] { this->read(text); }, part);
    expectError([&] { this->read(text); }, this->Path.string());
  }
}

TEST_F(ImportLegacyVtk, TruncatedFilesAreErrors)
{
  for (const bool binary : { false, true })
  {
    for (const bool offsets : { false, true })
    {
      const std::string whole = tetrahedra(binary, offsets);
      const std::size_t geometry = whole.find("POINT_DATA");
      const std::size_t fields = whole.find("METADATA");
      for (std::size_t size = 1; size + 2 < whole.size(); ++size)
      {
        // A file may end after its geometry or between two attributes, and the last number of a
        // text may be truncated.
        if (size + 4 < geometry || (binary && size > geometry + 13 && size + 2 < fields))
        {
          EXPECT_NE(messageOf([&] { this->read(whole.substr(0, size)); }), "") << size;
        }
      }
    }
  }
}

TEST_F(ImportLegacyVtk, ManyPolygonsPassThroughTheLeastMemory)
{
  // Lists and columns are longer than any window or chunk in memory.
  constexpr std::int64_t Cells = 300000;
  std::vector<float> points;
  std::vector<std::int32_t> list;
  std::vector<double> values;
  for (std::int64_t i = 0; i < Cells + 2; ++i)
  {
    points.insert(points.end(), { static_cast<float>(i), static_cast<float>(i % 2), 0.0f });
    values.push_back(static_cast<double>(i) / 3);
  }
  for (std::int32_t i = 0; i < Cells; ++i)
  {
    list.insert(list.end(), { 3, i, i + 1, i + 2 });
  }
  const ReadMesh mesh = this->read(
    head(true, "3.0", "POLYDATA") + "POINTS 300002 float\n" + written(points, true) +
    "POLYGONS 300000 1200000\n" + written(list, true) +
    "POINT_DATA 300002\nSCALARS s double\nLOOKUP_TABLE default\n" + written(values, true));
  ASSERT_EQ(mesh.cells(), Cells);
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  for (std::size_t i = 0; i < static_cast<std::size_t>(Cells); ++i)
  {
    ASSERT_EQ(mesh.corners[3 * i + 2], static_cast<std::int64_t>(i) + 2);
    ASSERT_EQ(mesh.positions[3 * i], static_cast<double>(i));
    ASSERT_EQ(mesh.vertexColumns[0].value(i), static_cast<double>(i) / 3);
  }
}

} // namespace smg::testing
