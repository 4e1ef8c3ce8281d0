// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/RestoredMesh.h"

#include "Testing/IO/MeshText.h"
#include "Testing/IO/RestoredMeshFixture.h"
#include "Testing/Support/ColumnValues.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/FormatSuffixes.h"
#include "Testing/Support/ProgressRecord.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace smg::testing
{
namespace
{

using RestoredMeshTest = RestoredMeshFixture;

/** The cells with polygons of more than `most` corners as fans of triangles. */
std::vector<Corners> cutAbove(const std::vector<Corners>& cells, std::size_t most)
{
  std::vector<Corners> cut;
  for (const Corners& cell : cells)
  {
    for (std::size_t i = 2; i < cell.size() && cell.size() > most; ++i)
    {
      cut.push_back({ cell[0], cell[i - 1], cell[i] });
    }
    if (cell.size() <= most)
    {
      cut.push_back(cell);
    }
  }
  return cut;
}

TEST_F(RestoredMeshTest, PolygonsAreTheSameInFormatsThatHaveThem)
{
  const auto hasPolygons = [](auto& format, auto&)
  { return format.writer && format.maxCorners > 4; };
  for (const std::string& suffix : suffixesWhere(hasPolygons))
  {
    for (const bool isDouble : { true, false })
    {
      SCOPED_TRACE(suffix + (isDouble ? " double" : " single"));
      const MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 9, isDouble, isDouble ? 1 : 2);
      const FileMesh back = this->restored(mesh, suffix);
      EXPECT_EQ(back.points.size(), mesh.points.size());
      if (isDouble)
      {
        EXPECT_EQ(back.points, mesh.points);
      }
      else
      {
        // The text of a float is a number whose nearest float it is.
        EXPECT_EQ(std::vector<float>(back.points.begin(), back.points.end()),
          std::vector<float>(mesh.points.begin(), mesh.points.end()));
      }
      EXPECT_EQ(back.cells, mesh.cells);
    }
  }
}

TEST_F(RestoredMeshTest, LargerPolygonsAreTrianglesInFormatsWithout)
{
  const MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 7, true);
  const FileMesh gmsh = this->restored(mesh, ".msh");
  EXPECT_EQ(gmsh.points, mesh.points);
  EXPECT_EQ(gmsh.cells, cutAbove(mesh.cells, 4));
  EXPECT_TRUE(this->isNoted("Polygons of more than four corners"));

  const FileMesh medit = this->restored(mesh, ".mesh");
  EXPECT_TRUE(this->isNoted("columns are left out"));
  std::vector<Corners> expected = cutAbove(mesh.cells, 4);
  std::ranges::stable_sort(expected, {}, &Corners::size);
  EXPECT_EQ(medit.points, mesh.points);
  EXPECT_EQ(medit.cells, expected);
}

TEST_F(RestoredMeshTest, TrianglesOfStlHaveTheirCoordinates)
{
  for (const bool isDouble : { true, false })
  {
    const MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 5, isDouble);
    this->write(mesh, "out.stl");
    std::vector<double> expected;
    for (const Corners& triangle : cutAbove(mesh.cells, 3))
    {
      for (const std::int64_t corner : triangle)
      {
        expected.insert(
          expected.end(), mesh.points.begin() + 3 * corner, mesh.points.begin() + 3 * corner + 3);
      }
    }
    EXPECT_EQ(readStlPoints(this->Folder / "out.stl"), expected);
    EXPECT_TRUE(this->isNoted(
      "belong to no cell: they are left out, since .stl files do not have a place for them."));
  }
}

TEST_F(RestoredMeshTest, TetrahedraAreTheSame)
{
  for (const char* suffix : { ".vtu", ".vtk", ".mesh", ".msh" })
  {
    SCOPED_TRACE(suffix);
    const MeshOfFile mesh = randomMeshOfFile(CellType::Tetrahedron, 4, true);
    const FileMesh back = this->restored(mesh, suffix);
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.cells, mesh.cells);
  }
}

TEST_F(RestoredMeshTest, ColumnsTravelToIsolatedVerticesToo)
{
  const MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 6, true);
  for (const char* suffix : { ".vtk", ".vtp", ".vtu" })
  {
    SCOPED_TRACE(suffix);
    const FileMesh back = this->restored(mesh, suffix);
    ASSERT_EQ(back.pointData.size(), mesh.vertexColumns.size());
    ASSERT_EQ(back.cellData.size(), mesh.cellColumns.size());
    for (const Column& column : mesh.vertexColumns)
    {
      EXPECT_EQ(back.pointData.at(column.spec.name), valuesOf(column)) << column.spec.name;
    }
    for (const Column& column : mesh.cellColumns)
    {
      EXPECT_EQ(back.cellData.at(column.spec.name), valuesOf(column)) << column.spec.name;
    }
  }
  const FileMesh ply = this->restored(mesh, ".ply");
  EXPECT_EQ(ply.pointData.size(), 3U + 4U + 2U);
  EXPECT_EQ(ply.cellData.size(), 1U + 3U);
  EXPECT_EQ(ply.pointData.at("ny"), valuesOf(mesh.vertexColumns[0], 1));
  EXPECT_EQ(ply.pointData.at("alpha"), valuesOf(mesh.vertexColumns[1], 3));
  EXPECT_EQ(ply.pointData.at("label"), valuesOf(mesh.vertexColumns[3]));
  EXPECT_EQ(ply.cellData.at("group"), valuesOf(mesh.cellColumns[0]));
  EXPECT_EQ(ply.cellData.at("blue"), valuesOf(mesh.cellColumns[1], 2));
}

TEST_F(RestoredMeshTest, TheOrderOfTheStreamDoesNotMatter)
{
  const MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 30, true);
  for (std::uint64_t seed = 2; seed < 6; ++seed)
  {
    EXPECT_EQ(this->restored(mesh, ".off", seed).cells, mesh.cells);
  }
}

TEST_F(RestoredMeshTest, AFaceOfPlyMayHaveMoreCornersThanAByteCounts)
{
  MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 4, true);
  mesh.cells.back().resize(270);
  std::iota(mesh.cells.back().begin(), mesh.cells.back().end(), 20);
  EXPECT_EQ(this->restored(mesh, ".ply").cells, mesh.cells);
}

TEST_F(RestoredMeshTest, CellsThatAreNoFanStayWithTheirOwnValues)
{
  // Three triangles of a strip have one number; the last two have another one and are not a fan.
  MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 3, true);
  mesh.cells = { { 10, 11, 12 }, { 12, 11, 13 }, { 12, 13, 14 }, { 20, 21, 22 }, { 20, 23, 24 } };
  mesh.numbers = { 4, 4, 4, 9, 9 };
  mesh.cellColumns = { makeColumn<int>("part", std::vector<int>{ 0, 1, 2, 3, 4 }) };
  const FileMesh back = this->restored(mesh, ".vtp");
  EXPECT_TRUE(std::ranges::is_permutation(back.cells, mesh.cells));
  for (std::size_t i = 0; i < back.cells.size(); ++i)
  {
    EXPECT_EQ(mesh.cells[static_cast<std::size_t>(back.cellData.at("part")[i])], back.cells[i]);
  }
  EXPECT_TRUE(this->isNoted("2 cells of the original file"));
}

TEST_F(RestoredMeshTest, StripsStayTheirTriangles)
{
  const std::pair<const char*, std::vector<Corners>> strips[] = {
    // Triangles around a vertex, which would be a hexagon.
    { "15 0 1 2 -1 0 2 3 -1 0 3 4 -1 0 4 5",
      { { 0, 1, 2 }, { 2, 3, 0 }, { 3, 4, 0 }, { 4, 5, 0 } } },
    // The two of a quadrilateral, of which the second one would come first.
    { "7 0 1 2 -1 0 3 1", { { 0, 1, 2 }, { 3, 1, 0 } } },
    { "5 0 1 2 3 4", { { 0, 1, 2 }, { 2, 1, 3 }, { 2, 3, 4 } } }
  };
  for (const auto& [strip, triangles] : strips)
  {
    writeBytes(this->Folder / "strip.ply",
      std::string("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                  "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                  "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n-1 1 0\n-1 0 0\n") +
        strip + "\n");
    convert(this->Folder / "strip.ply", this->Folder / "mesh.vsm");
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.off", workspace);
    EXPECT_TRUE(
      std::ranges::is_permutation(readFileMesh(this->Folder / "out.off").cells, triangles))
      << strip;
  }
}

TEST_F(RestoredMeshTest, StripsAreTheirTrianglesInTheirOrder)
{
  for (int corners = 3; corners < 40; ++corners)
  {
    // As VTK's triangle filter splits it, between two polygons.
    std::vector<Corners> triangles{ { 0, 1, 2 } };
    std::string points, strip = std::to_string(corners);
    for (int k = 0; k < corners; ++k)
    {
      points += std::to_string(k / 2) + ' ' + std::to_string(k % 2) + " 0\n";
      strip += ' ' + std::to_string(k);
      if (k >= 2)
      {
        k % 2 == 0 ? triangles.push_back({ k - 2, k - 1, k })
                   : triangles.push_back({ k - 1, k - 2, k });
      }
    }
    writeBytes(this->Folder / "strip.vtk",
      "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS " + std::to_string(corners) +
        " float\n" + points + "POLYGONS 1 4\n3 0 1 2\nTRIANGLE_STRIPS 1 " +
        std::to_string(corners + 1) + '\n' + strip + '\n');
    convert(this->Folder / "strip.vtk", this->Folder / "mesh.vsm");
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.off", workspace);
    EXPECT_EQ(readFileMesh(this->Folder / "out.off").cells, triangles) << corners;
  }
}

TEST_F(RestoredMeshTest, SaysThatTheTrianglesOfAPolygonDiffer)
{
  MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 3, true);
  mesh.cells = { { 10, 11, 12 }, { 10, 12, 13 } };
  mesh.numbers = { 4, 4 };
  mesh.cellColumns = { makeColumn<int>("part", std::vector<int>{ 5, 6 }) };
  const FileMesh back = this->restored(mesh, ".off");
  EXPECT_EQ(back.cells, (std::vector<Corners>{ { 10, 11, 12, 13 } }));
  EXPECT_TRUE(this->isNoted("1 polygon was triangles with different values"));
}

TEST_F(RestoredMeshTest, PolygonsTooLargeForTheMemoryAreTriangles)
{
  MeshOfFile mesh;
  Corners large(100000);
  std::iota(large.begin(), large.end(), 0);
  mesh.points.resize(3 * large.size());
  mesh.cells = { { 1, 2, 3, 4 }, large, { 5, 6, 7, 8, 9 } };
  mesh.numbers = { 0, 1, 2 };
  std::vector<Corners> back = this->restored(mesh, ".off").cells;
  EXPECT_TRUE(this->isNoted("1 polygon of more than"));
  ASSERT_EQ(back.size(), large.size());
  EXPECT_EQ(back.front(), mesh.cells.front());
  EXPECT_EQ(back.back(), mesh.cells.back());
  std::ranges::sort(back.begin() + 1, back.end() - 1);
  const std::vector<Corners> triangles = cutAbove({ large }, 3);
  EXPECT_TRUE(std::equal(triangles.begin(), triangles.end(), back.begin() + 1));
}

TEST_F(RestoredMeshTest, ALargeStripIsNoPolygonForWhichMoreMemoryWouldHelp)
{
  MeshOfFile mesh;
  constexpr std::int64_t Triangles = 100000;
  mesh.points.resize(3 * (Triangles + 2));
  for (std::int64_t i = 0; i < Triangles; ++i)
  {
    mesh.cells.push_back(i % 2 == 0 ? Corners{ i, i + 1, i + 2 } : Corners{ i + 1, i, i + 2 });
  }
  mesh.numbers.assign(mesh.cells.size(), 0);
  std::vector<Corners> back = this->restored(mesh, ".off").cells;
  std::ranges::sort(back);
  std::ranges::sort(mesh.cells);
  EXPECT_EQ(back, mesh.cells);
  EXPECT_TRUE(this->isNoted("1 cell of the original file"));
  EXPECT_FALSE(this->isNoted("polygon"));
  EXPECT_FALSE(this->isNoted("memory"));
}

TEST_F(RestoredMeshTest, RefusesWhatIsNotTheWholeMesh)
{
  const auto restore = [this](const MeshOfFile& mesh) { this->write(mesh, "out.ply"); };
  const MeshOfFile good = randomMeshOfFile(CellType::Triangle, 3, true);
  MeshOfFile bad = good;
  bad.numbers[0] = -1;
  expectError([&] { restore(bad); }, "OriginalCellId -1");

  const auto withIds = [this](Corners ids)
  {
    StreamMesh stream;
    stream.positions = std::vector<double>(3 * ids.size(), 0.0);
    stream.corners = { 0, 1, 2 };
    stream.vertexColumns = { makeColumn<std::int64_t>("OriginalId", ids) };
    testing::write(this->Folder / "mesh.vsm", stream);
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.ply", workspace);
  };
  expectError([&] { withIds({ 0, 3, 1 }); }, "original number 3");
  expectError([&] { withIds({ 0, -1, 1 }); }, "original number -1");
  expectError([&] { withIds({ 2, 1, 1 }); }, "no vertex has the original number 0");
  expectError([&] { withIds({ 0, 1, 1 }); }, "two vertices have the original number 1");
  EXPECT_NO_THROW(withIds({ 2, 0, 1 }));
  std::filesystem::remove(this->Folder / "out.ply");

  testing::write(this->Folder / "mesh.vsm", toStream(grid(3, 3)));
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  expectError([&]
    { writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.ply", workspace); },
    "no column OriginalId");
  EXPECT_FALSE(std::filesystem::exists(this->Folder / "out.ply"));
}

TEST_F(RestoredMeshTest, StreamsAreWrittenInTheirOrderToo)
{
  for (const IndexedTestMesh& mesh : { torus(9, 7, 0.1), tetBox(4, 3, 3, 0.1) })
  {
    StreamMesh stream = toStream(mesh);
    const bool isSurface = stream.cellType == CellType::Triangle;
    stream.vertexColumns = { randomColumn(
      { "OriginalId", ScalarType::Int64, 1 }, stream.vertices(), 3) };
    testing::write(this->Folder / "mesh.vsm", stream);
    const auto isOneFile = [&](auto& format, auto& suffix)
    {
      return format.writer && format.holdsVertices && !format.furtherOutputs &&
             suffix.holds(stream.cellType);
    };
    for (const std::string& suffix : suffixesWhere(isOneFile))
    {
      SCOPED_TRACE(suffix);
      const std::filesystem::path out = this->Folder / ("out" + suffix);
      EXPECT_TRUE(writeFromVsm(this->Folder / "mesh.vsm", out, {}, this->Folder.path()).empty());
      const FileMesh back = readFileMesh(out);
      EXPECT_EQ(back.points, stream.positions);
      Corners corners;
      for (const Corners& cell : back.cells)
      {
        corners.insert(corners.end(), cell.begin(), cell.end());
      }
      EXPECT_EQ(corners, stream.corners);
    }
    if (isSurface)
    {
      writeFromVsm(this->Folder / "mesh.vsm", this->Folder / "out.stl", {}, this->Folder.path());
      std::vector<double> points;
      for (const std::int64_t corner : stream.corners)
      {
        const auto point = stream.positions.begin() + 3 * corner;
        points.insert(points.end(), point, point + 3);
      }
      EXPECT_EQ(readStlPoints(this->Folder / "out.stl"), points);
    }
  }
}

TEST_F(RestoredMeshTest, RefusesFormatsThatCannotHaveIt)
{
  const MeshOfFile surface = randomMeshOfFile(CellType::Triangle, 3, true);
  const MeshOfFile volume = randomMeshOfFile(CellType::Tetrahedron, 4, true);
  expectError([&] { this->write(surface, "out"); }, "an order of its own");
  const auto isStream = [](auto& format, auto&) { return !format.writer; };
  for (const std::string& suffix : suffixesWhere(isStream))
  {
    expectError([&] { this->write(surface, "out" + suffix); }, "an order of its own");
  }
  const auto isSurface = [](auto& format, auto& suffix)
  { return format.writer && !suffix.tetrahedra; };
  for (const std::string& suffix : suffixesWhere(isSurface))
  {
    expectError([&] { this->write(volume, "out" + suffix); }, "holds no tetrahedra");
  }
  EXPECT_EQ(this->Folder.entries(), 1);
}

TEST_F(RestoredMeshTest, CanBeCancelledAtAnyTime)
{
  writeVsmOf(randomMeshOfFile(CellType::Triangle, 5, true), this->Folder / "mesh.vsm");
  const auto run = [this](const ProgressFunction& progress)
  {
    Workspace workspace(this->Folder.path(), Workspace::MinMemory, progress);
    workspace.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
    writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.ply", workspace);
  };
  std::vector<double> fractions;
  run(
    [&fractions](double done)
    {
      fractions.push_back(done);
      return true;
    });
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(fractions.back(), 1.0);
  std::filesystem::remove(this->Folder / "out.ply");
  for (std::size_t stop = 0; stop + 1 < fractions.size(); ++stop)
  {
    std::size_t calls = 0;
    EXPECT_THROW(run([&](double) { return calls++ < stop; }), Cancelled);
    EXPECT_EQ(this->Folder.entries(), 1);
  }
}

/** A quarter of a million vertices, a third of them isolated, with columns. */
class LargeRestoredMesh : public RestoredMeshTest
{
protected:
  void SetUp() override
  {
    const IndexedTestMesh lattice = shuffled(grid(400, 418, 0.1));
    this->Mesh.points.resize(std::size_t(3) * Vertices);
    Random random(5);
    std::ranges::generate(this->Mesh.points, [&random] { return random.uniform(); });
    // Of each three vertices, the last one belongs to no cell.
    for (std::int64_t c = 0; c < lattice.cells(); ++c)
    {
      Corners cell;
      for (int k = 0; k < 3; ++k)
      {
        const std::int64_t corner = lattice.corners[std::size_t(3 * c + k)];
        cell.push_back(corner / 2 * 3 + corner % 2);
      }
      this->Mesh.cells.push_back(cell);
      this->Mesh.numbers.push_back(c);
    }
    this->Mesh.vertexColumns = { randomColumn({ "a", ScalarType::Float64, 3 }, Vertices, 3) };
    this->Mesh.cellColumns = { randomColumn(
      { "b", ScalarType::Int32, 1 }, std::int64_t(this->Mesh.cells.size()), 4) };
    writeVsmOf(this->Mesh, this->Folder / "mesh.vsm");
  }

  static constexpr std::int64_t Vertices = 400 * 418 / 2 * 3;
  MeshOfFile Mesh;
};

TEST_F(LargeRestoredMesh, IsRestoredInLittleMemory)
{
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  VsmReader reader(this->Folder / "mesh.vsm");
  RestoredMesh restored(reader, workspace, std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(restored.info().vertices, Vertices);
  EXPECT_EQ(restored.info().isolated, Vertices / 3);
  std::vector<double> points;
  Column a{ this->Mesh.vertexColumns[0].spec, {} };
  Column b{ this->Mesh.cellColumns[0].spec, {} };
  std::vector<Corners> cells;
  for (VertexChunk vertices; restored.next(vertices);)
  {
    EXPECT_EQ(vertices.first, std::int64_t(points.size() / 3));
    points.insert(points.end(), vertices.positions.begin(), vertices.positions.end());
    const std::vector<std::byte>& bytes = vertices.columns[0].bytes;
    a.bytes.insert(a.bytes.end(), bytes.begin(), bytes.end());
  }
  for (ElementChunk elements; restored.next(elements);)
  {
    EXPECT_EQ(elements.first, std::int64_t(cells.size()));
    elements.forEach([&cells](std::span<const std::int64_t> corners, std::size_t)
      { cells.emplace_back(corners.begin(), corners.end()); });
    const std::vector<std::byte>& bytes = elements.columns[0].bytes;
    b.bytes.insert(b.bytes.end(), bytes.begin(), bytes.end());
  }
  EXPECT_TRUE(points == this->Mesh.points);
  EXPECT_TRUE(cells == this->Mesh.cells);
  EXPECT_TRUE(a.bytes == this->Mesh.vertexColumns[0].bytes);
  EXPECT_TRUE(b.bytes == this->Mesh.cellColumns[0].bytes);
  EXPECT_LE(workspace.pool().peak(), Workspace::MinMemory);
  EXPECT_GT(workspace.traffic().bytesWritten, Vertices * 24);
}

TEST_F(LargeRestoredMesh, GoesToStlInLittleMemory)
{
  std::ranges::transform(
    this->Mesh.points, this->Mesh.points.begin(), [](double x) { return static_cast<float>(x); });
  this->Mesh.doublePositions = false;
  writeVsmOf(this->Mesh, this->Folder / "mesh.vsm");
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.stl", workspace);
  const std::vector<double> points = readStlPoints(this->Folder / "out.stl");
  ASSERT_EQ(points.size(), 9 * this->Mesh.cells.size());
  bool same = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t corner = this->Mesh.cells[i / 9][i / 3 % 3];
    same = same && points[i] == this->Mesh.points[std::size_t(3 * corner) + i % 3];
  }
  EXPECT_TRUE(same);
  EXPECT_LE(workspace.pool().peak(), Workspace::MinMemory);
}

} // namespace
} // namespace smg::testing
