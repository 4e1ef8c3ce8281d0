// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/MeshFile.h"
#include "Testing/IO/RestoredMeshFixture.h"
#include "Testing/Support/ColumnValues.h"
#include "Testing/Support/RawMeshReading.h"

#include <numeric>
#include <utility>

namespace smg::testing
{
namespace
{

using RestoredColumns = RestoredMeshFixture;

/** Columns that the text formats can hold, and one that they cannot. */
void giveTextColumns(MeshOfFile& mesh)
{
  const auto points = static_cast<std::size_t>(mesh.vertices());
  const auto add = [](std::vector<Column>& columns, const char* name, int components,
                     std::size_t tuples, auto valueOf)
  {
    std::vector<decltype(valueOf(0))> values(tuples * static_cast<std::size_t>(components));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = valueOf(static_cast<int>(i));
    }
    columns.push_back(makeColumn<decltype(valueOf(0))>(name, values, components));
  };
  const auto share = [](int i) { return (i % 11) / 10.0; };
  const auto label = [](int i) { return std::int64_t(i % 7 - 2); };
  const auto byte = [](int i) { return static_cast<std::uint8_t>(255 - i % 256); };
  const auto real = [](int i) { return 1.0 / (i + 1); };
  mesh.vertexColumns.clear();
  add(mesh.vertexColumns, "Normals", 3, points, share);
  add(mesh.vertexColumns, "Colors", 4, points, byte);
  add(mesh.vertexColumns, "TextureCoordinates", 2, points, share);
  add(mesh.vertexColumns, "Reference", 1, points, label);
  add(mesh.vertexColumns, "Attribute", 2, points, real);
  add(mesh.vertexColumns, "Marker", 1, points, label);
  add(mesh.vertexColumns, "height", 1, points, real);
  const std::size_t cells = mesh.cells.size();
  mesh.cellColumns.clear();
  add(mesh.cellColumns, "Colors", 3, cells, byte);
  add(mesh.cellColumns, "Reference", 1, cells, label);
  add(mesh.cellColumns, "PhysicalTag", 1, cells, label);
  add(mesh.cellColumns, "GeometricalTag", 1, cells, label);
  add(mesh.cellColumns, "Attribute", 3, cells, real);
}

void expectColumns(const std::vector<Column>& columns, const std::vector<Column>& of,
  const std::vector<std::string>& names)
{
  std::vector<std::string> found;
  for (const Column& column : columns)
  {
    if (isGroupColumn(column.spec.name))
    {
      continue; // made of labels: see Groups
    }
    found.push_back(column.spec.name);
    const auto same =
      std::ranges::find(of, column.spec.name, [](const Column& other) { return other.spec.name; });
    ASSERT_NE(same, of.end());
    EXPECT_EQ(column.spec, same->spec);
    EXPECT_EQ(valuesOf(column), valuesOf(*same)) << column.spec.name;
  }
  EXPECT_TRUE(std::ranges::is_permutation(found, names)) << ::testing::PrintToString(found);
}

TEST_F(RestoredColumns, TextFormatsKeepTheColumnsThatTheyHaveAPlaceFor)
{
  using Names = std::vector<std::string>;
  const struct
  {
    const char* suffix;
    Names ofVertices, ofElements;
  } formats[] = {
    { ".off", { "Normals", "Colors", "TextureCoordinates" }, { "Colors" } },
    { ".mesh", { "Reference" }, { "Reference" } },
    { ".node", { "Attribute", "Marker" }, { "Attribute" } },
    { ".ele", { "Attribute", "Marker" }, { "Attribute" } },
  };
  for (const auto& [suffix, ofVertices, ofElements] : formats)
  {
    for (const CellType type : { CellType::Triangle, CellType::Tetrahedron })
    {
      if (type == CellType::Tetrahedron && std::string(suffix) == ".off")
      {
        continue;
      }
      SCOPED_TRACE(suffix);
      MeshOfFile mesh = randomMeshOfFile(type, 6, true);
      std::erase_if(mesh.cells, [](const Corners& cell) { return cell.size() > 4; });
      std::ranges::stable_sort(mesh.cells, {}, &Corners::size);
      if (std::string(suffix) == ".node" || std::string(suffix) == ".ele")
      {
        std::erase_if(
          mesh.cells, [type](const Corners& cell) { return std::ssize(cell) != cornersOf(type); });
      }
      mesh.numbers.resize(mesh.cells.size());
      std::iota(mesh.numbers.begin(), mesh.numbers.end(), 0);
      giveTextColumns(mesh);
      this->write(mesh, std::string("out") + suffix);
      EXPECT_TRUE(this->isNoted("'height'"));
      Workspace workspace(this->Folder.path(), Workspace::MinMemory);
      const ReadMesh back =
        readRaw(importMesh(this->Folder / (std::string("out") + suffix), workspace));
      EXPECT_EQ(back.positions, mesh.points);
      EXPECT_EQ(back.cells(),
        std::accumulate(mesh.cells.begin(), mesh.cells.end(), std::int64_t(0),
          [type](std::int64_t sum, const Corners& cell)
          { return sum + (type == CellType::Triangle ? std::int64_t(cell.size()) - 2 : 1); }));
      expectColumns(back.vertexColumns, mesh.vertexColumns, ofVertices);
      expectColumns(back.elementColumns, mesh.cellColumns, ofElements);
    }
  }
}

TEST_F(RestoredColumns, LabelsThatAreNoIntegersAreLeftOut)
{
  MeshOfFile mesh = randomMeshOfFile(CellType::Tetrahedron, 4, true);
  const std::vector<double> halves(mesh.cells.size(), 0.5);
  mesh.vertexColumns.clear();
  mesh.cellColumns = { makeColumn<double>("Reference", halves),
    makeColumn<double>("PhysicalTag", halves) };
  this->write(mesh, "out.mesh");
  EXPECT_TRUE(this->isNoted("cell 'Reference', cell 'PhysicalTag'"));
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  EXPECT_TRUE(importMesh(this->Folder / "out.mesh", workspace).elementColumns.empty());
}

TEST_F(RestoredColumns, LabelsTravelBetweenFormatsThatCallThemDifferently)
{
  MeshOfFile mesh = randomMeshOfFile(CellType::Tetrahedron, 4, true);
  std::vector<int> labels(mesh.cells.size());
  std::iota(labels.begin(), labels.end(), 5);
  mesh.vertexColumns.clear();
  for (const auto& [from, to] : { std::pair("Reference", "out.msh"),
         std::pair("PhysicalTag", "out.mesh"), std::pair("Reference", "out.ele") })
  {
    mesh.cellColumns = { makeColumn<int>(from, labels) };
    this->write(mesh, to);
    EXPECT_TRUE(this->Notes.empty());
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    const ReadMesh back = readRaw(importMesh(this->Folder / to, workspace));
    // Labels are groups, too.
    ASSERT_EQ(
      back.elementColumns.size(), back.elementColumns.back().spec.name == CellGroupsName ? 2U : 1U);
    EXPECT_EQ(valuesOf(back.elementColumns[0]), valuesOf(mesh.cellColumns[0])) << to;
  }
}

TEST_F(RestoredColumns, ColoursOfObjAreFromZeroToOne)
{
  MeshOfFile mesh = randomMeshOfFile(CellType::Triangle, 4, true);
  giveTextColumns(mesh);
  this->write(mesh, "out.obj");
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  const ReadMesh back = readRaw(importMesh(this->Folder / "out.obj", workspace));
  ASSERT_EQ(back.vertexColumns.size(), 1U);
  EXPECT_EQ(back.vertexColumns[0].spec, (ColumnSpec{ "Colors", ScalarType::Float32, 3 }));
  EXPECT_TRUE(this->isNoted("The opacity of the colours is left out"));
  for (std::size_t i = 0; i < back.vertexColumns[0].tuples(); ++i)
  {
    EXPECT_EQ(back.vertexColumns[0].value(i, 1),
      static_cast<float>(mesh.vertexColumns[1].value(i, 1) / 255));
  }
}

} // namespace
} // namespace smg::testing
