// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Import/ImportColumn.h"

#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

using Numbers = std::vector<std::int64_t>;

class RawMeshBuilderTest : public ::testing::Test
{
protected:
  /** The mesh that `build` makes from five vertices. */
  ReadMesh built(
    const std::function<void(RawMeshBuilder&)>& build, CellChoice choice = CellChoice::Only)
  {
    RawMeshBuilder builder(this->Space, choice);
    for (int i = 0; i < 5; ++i)
    {
      builder.vertex(i, 0.1 * i, -i);
    }
    build(builder);
    return readRaw(builder.finish());
  }

  void expectRefused(const std::function<void(RawMeshBuilder&)>& build, const std::string& part)
  {
    try
    {
      this->built(build);
      FAIL() << "not refused: " << part;
    }
    catch (const MeshError& error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  TemporaryFolder Folder;
  Workspace Space{ this->Folder.path(), Workspace::MinMemory };
};

} // namespace

TEST_F(RawMeshBuilderTest, CellsAreElementsUntilOneIsNot)
{
  const ReadMesh same = this->built(
    [](RawMeshBuilder& builder)
    {
      builder.triangle(0, 1, 2);
      builder.polygon(Numbers{ 1, 2, 3 });
    });
  EXPECT_EQ(same.corners, (Numbers{ 0, 1, 2, 1, 2, 3 }));
  EXPECT_EQ(same.elements, (Numbers{ 0, 1 }));
  const ReadMesh mixed = this->built(
    [](RawMeshBuilder& builder)
    {
      builder.triangle(0, 1, 2);
      builder.polygon(Numbers{ 0, 1, 2, 3, 4 });
      builder.polygon(Numbers{ 0, 1 });
      builder.dropped();
      builder.triangle(2, 3, 4);
      builder.dropped();
    });
  EXPECT_EQ(mixed.corners, (Numbers{ 0, 1, 2, 0, 1, 2, 0, 2, 3, 0, 3, 4, 2, 3, 4 }));
  EXPECT_EQ(mixed.elements, (Numbers{ 0, 1, 1, 1, 4 }));
  EXPECT_EQ(mixed.elementCount, 6);
  EXPECT_EQ(mixed.counts.droppedCells, 3);
  EXPECT_EQ(mixed.counts.triangulatedPolygons, 1);
}

TEST_F(RawMeshBuilderTest, StripsAlternate)
{
  const ReadMesh mesh = this->built(
    [](RawMeshBuilder& builder)
    {
      const auto twoStrips = [&builder](const Numbers& first, const Numbers& second)
      {
        std::ranges::for_each(first, [&](std::int64_t corner) { builder.stripCorner(corner); });
        builder.endStrip();
        std::ranges::for_each(second, [&](std::int64_t corner) { builder.stripCorner(corner); });
        builder.endTriangles();
      };
      twoStrips({ 0, 1, 2, 3, 4 }, { 2, 1, 0 });
      twoStrips({ 0, 1 }, { 2, 3 });
      builder.strip(Numbers{ 4, 3, 2 });
    });
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 2, 1, 3, 2, 3, 4, 2, 1, 0, 4, 3, 2 }));
  EXPECT_EQ(mesh.elements, (Numbers{ 0, 0, 0, 0, 2 }));
  EXPECT_EQ(mesh.counts.droppedCells, 1);
}

TEST_F(RawMeshBuilderTest, KindsAreChosen)
{
  const auto build = [](RawMeshBuilder& builder)
  {
    builder.triangle(0, 1, 2);
    builder.tetrahedron(0, 1, 2, 3);
    builder.polygon(Numbers{ 0, 1, 2, 3 });
    builder.solid(Numbers{ 0, 1, 2, 3, 4 });
    builder.strip(Numbers{ 0, 1, 2 });
  };
  EXPECT_EQ(this->built(build, CellChoice::Only).elements, (Numbers{ 1, 3, 3 }));
  const ReadMesh triangles = this->built(build, CellChoice::Triangles);
  EXPECT_EQ(triangles.cellType, CellType::Triangle);
  EXPECT_EQ(triangles.elements, (Numbers{ 0, 2, 2, 4 }));
  EXPECT_EQ(triangles.counts.splitCells, 0);
  const ReadMesh tetrahedra = this->built(build, CellChoice::Tetrahedra);
  EXPECT_EQ(tetrahedra.cellType, CellType::Tetrahedron);
  EXPECT_EQ(tetrahedra.elements, (Numbers{ 1, 3, 3 }));
  EXPECT_EQ(tetrahedra.counts.droppedCells, 3);
  EXPECT_EQ(tetrahedra.counts.splitCells, 1);
  EXPECT_EQ(tetrahedra.counts.triangulatedPolygons, 0);
}

TEST_F(RawMeshBuilderTest, CollapsedSolidsAreDropped)
{
  const ReadMesh mesh = this->built(
    [](RawMeshBuilder& builder)
    {
      builder.solid(Numbers{ 0, 1, 1, 0, 0 });
      builder.tetrahedron(0, 1, 2, 3);
    });
  EXPECT_EQ(mesh.elements, (Numbers{ 1 }));
  EXPECT_EQ(mesh.counts.droppedCells, 1);
  EXPECT_EQ(mesh.counts.splitCells, 0);
}

TEST_F(RawMeshBuilderTest, CoordinatesAreFiniteInTheirPrecision)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { infinity, -infinity, std::numeric_limits<double>::quiet_NaN() })
  {
    this->expectRefused(
      [bad](RawMeshBuilder& builder) { builder.vertex(0, bad, 0); }, "not finite");
  }
  RawMeshBuilder builder(this->Space, CellChoice::Only);
  builder.useSinglePrecision();
  EXPECT_THROW(builder.vertex(0, 0, 1e39), MeshError);
  builder.vertex(0.1, 1e38, 0);
  builder.triangle(0, 0, 0);
  const ReadMesh mesh = readRaw(builder.finish());
  EXPECT_FALSE(mesh.doublePositions);
  EXPECT_EQ(mesh.positions[0], static_cast<double>(0.1f));
}

TEST_F(RawMeshBuilderTest, CornersAreVertices)
{
  this->expectRefused(
    [](RawMeshBuilder& b) { b.triangle(0, 1, 5); }, "the corner 5 is not a vertex");
  this->expectRefused([](RawMeshBuilder& b) { b.triangle(0, -1, 2); }, "the corner -1");
  this->expectRefused([](RawMeshBuilder& b) { b.triangle(0, 1, std::int64_t(1) << 32); }, "corner");
  this->expectRefused([](RawMeshBuilder& b) { b.triangle(0, 1, NoIndex - 1); }, "corner");
  this->expectRefused([](RawMeshBuilder& b) { b.dropped(); }, "no triangles and no tetrahedra");
  this->expectRefused(
    [](RawMeshBuilder& b) {
      b.strip(Numbers{ 0, 1, 2, -5, 0, 1, 2 });
    },
    "the corner -5");
}

TEST_F(RawMeshBuilderTest, CornersAreNumbersOfTheFile)
{
  const ReadMesh mesh = this->built(
    [](RawMeshBuilder& builder)
    {
      builder.numberVertices(7, 3);
      builder.triangle(7, 8, 9);
      builder.numberVertices(-1, 3, 2);
      builder.triangle(-1, 0, 1);
    });
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 2, 3, 4 }));
  const auto triangle = [](std::int64_t corner)
  {
    return [corner](RawMeshBuilder& builder)
    {
      builder.numberVertices(7, 3);
      builder.triangle(7, 8, corner);
    };
  };
  constexpr std::int64_t Least = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t corner : { std::int64_t(6), std::int64_t(10), Least, -(Least + 1) })
  {
    this->expectRefused(
      triangle(corner), "corner " + std::to_string(corner) + " is not a vertex: they are 7 to 9");
  }
  try
  {
    this->built(
      [](RawMeshBuilder& builder)
      {
        builder.numberVertices(1);
        builder.setLine(12);
        builder.triangle(1, 2, 6);
        builder.setLine(13);
        builder.triangle(1, 2, 3);
        builder.checkCorners();
      });
    FAIL() << "not refused";
  }
  catch (const MeshError& error)
  {
    EXPECT_STREQ(error.what(), "the corner 6 is not a vertex: they are 1 to 5");
    EXPECT_EQ(error.line(), 12);
  }
}

TEST_F(RawMeshBuilderTest, CellsOfTheKindThatIsWantedMustBeThere)
{
  const auto complaint = [this](CellChoice choice)
  {
    RawMeshBuilder builder(this->Space, choice);
    for (int i = 0; i < 4; ++i)
    {
      builder.vertex(i, 0, 0);
    }
    choice == CellChoice::Triangles ? builder.tetrahedron(0, 1, 2, 3) : builder.triangle(0, 1, 2);
    try
    {
      builder.finish();
    }
    catch (const MeshError& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(CellChoice::Triangles), "the file has no triangles (option --cells)");
  EXPECT_EQ(complaint(CellChoice::Tetrahedra), "the file has no tetrahedra (option --cells)");
}

TEST_F(RawMeshBuilderTest, TheFlagsOfCellsAreNoColumn)
{
  RawMeshBuilder builder(this->Space, CellChoice::Only);
  const ColumnSpec flags{ CellFlagsName, ScalarType::UInt8, 1 };
  EXPECT_FALSE(ImportColumn(builder, ColumnOf::Elements, flags).exists());
  ImportColumn column(builder, ColumnOf::Vertices, flags);
  EXPECT_TRUE(column.exists());
  column.drop();
  for (int i = 0; i < 3; ++i)
  {
    builder.vertex(i, 0, 0);
  }
  builder.triangle(0, 1, 2);
  EXPECT_EQ(builder.finish().counts.droppedColumns, std::vector<std::string>{ CellFlagsName });
}

TEST_F(RawMeshBuilderTest, CornersAreRelabelled)
{
  const auto build = [this](std::int64_t last)
  {
    return [this, last](RawMeshBuilder& builder)
    {
      builder.tetrahedron(100, 4000000000, 7, last);
      Relabelling numbers(this->Space, 4000000001, 1 << 20);
      numbers.put(100, 1);
      numbers.put(7, 0);
      numbers.put(4000000000, 4);
      numbers.put(8, 3);
      builder.relabelCorners(std::move(numbers));
    };
  };
  EXPECT_EQ(this->built(build(8)).corners, (Numbers{ 1, 4, 0, 3 }));
  this->expectRefused(build(9), "a vertex that the file does not have");
}

TEST_F(RawMeshBuilderTest, ColumnsHaveATupleForEachVertexAndElement)
{
  const ColumnSpec spec{ "heat", ScalarType::Int32, 2 };
  const std::vector<std::int32_t> tuples{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 };
  const auto build = [&](std::size_t vertexTuples, std::size_t elementTuples, bool drop)
  {
    return [=, &spec, &tuples](RawMeshBuilder& builder)
    {
      const auto column = [&builder](ColumnOf of, const ColumnSpec& added)
      { return ImportColumn(builder, of, added); };
      ImportColumn other = column(ColumnOf::Vertices, { "other", ScalarType::Float64, 1 });
      ImportColumn ofVertices = column(ColumnOf::Vertices, spec);
      ImportColumn ofElements = column(ColumnOf::Elements, spec);
      ImportColumn none = column(ColumnOf::Vertices, { "Position", ScalarType::Float64, 3 });
      EXPECT_FALSE(none.exists());
      EXPECT_FALSE(column(ColumnOf::Vertices, spec).exists()) << "a name that is taken";
      none.append(std::as_bytes(std::span(tuples)));
      ofVertices.append(std::as_bytes(std::span(tuples).first(2 * vertexTuples)));
      ofElements.append(std::as_bytes(std::span(tuples).first(2 * elementTuples)));
      other.drop();
      if (drop)
      {
        ofElements.drop();
      }
      builder.triangle(0, 1, 2);
      builder.dropped();
    };
  };
  const ReadMesh mesh = this->built(build(5, 2, false));
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, spec);
  EXPECT_EQ(mesh.vertexColumns[0].value(4, 1), 9);
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(mesh.elementColumns[0].value(1, 0), 2);
  EXPECT_EQ(mesh.counts.droppedColumns, (std::vector<std::string>{ "Position", "heat" }));
  EXPECT_TRUE(this->built(build(5, 1, true)).elementColumns.empty());
  this->expectRefused(build(4, 2, false), "the column 'heat' has 4 values, not 5");
  this->expectRefused(build(5, 3, false), "the column 'heat' has 3 values, not 2");
}

} // namespace smg::testing
