// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/Support/RawMeshReading.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace smg::testing
{
namespace
{

class WritePly : public ::testing::Test
{
protected:
  /** Writes the mesh as out.ply. */
  std::vector<std::string> writeAsPly(const StreamMesh& mesh, WriteOptions options = {})
  {
    write(this->Folder / "mesh.vsm", mesh, options);
    const auto source = VsmReader(this->Folder / "mesh.vsm").source();
    return writeMesh(*source, this->Folder / "out.ply");
  }

  std::string header() const
  {
    const std::string text = readFile(this->Folder / "out.ply");
    return text.substr(0, text.find("end_header"));
  }

  TemporaryFolder Folder;
};

/** A stream with a column for each kind of properties that has a meaning. */
StreamMesh streamWithColumns()
{
  StreamMesh mesh = toStream(torus(30, 20, 0.2));
  const auto vertex = [&mesh](const char* name, ScalarType type, int components) {
    mesh.vertexColumns.push_back(randomColumn({ name, type, components }, mesh.vertices(), 3));
  };
  vertex("Normals", ScalarType::Float32, 3);
  vertex("Colors", ScalarType::UInt8, 4);
  vertex("confidence", ScalarType::Float64, 1);
  vertex("material", ScalarType::Int16, 1);
  mesh.cellColumns.push_back(randomColumn({ "Colors", ScalarType::UInt8, 3 }, mesh.cells(), 4));
  mesh.cellColumns.push_back(randomColumn({ "group", ScalarType::UInt32, 1 }, mesh.cells(), 5));
  return mesh;
}

TEST_F(WritePly, ComesBackWithItsColumns)
{
  for (const bool single : { false, true })
  {
    StreamMesh mesh = streamWithColumns();
    if (single)
    {
      mesh.positions.assign(mesh.positions.size(), 0.1F);
    }
    EXPECT_TRUE(this->writeAsPly(mesh, { .single = single }).empty());
    const ReadMesh back = importWhole(this->Folder / "out.ply");
    EXPECT_EQ(back.doublePositions, !single);
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.corners, mesh.corners);
    expectSame(back.vertexColumns, mesh.vertexColumns);
    expectSame(back.elementColumns, mesh.cellColumns);
  }
  EXPECT_NE(this->header().find("property float nx\n"), std::string::npos);
  EXPECT_NE(this->header().find("property uchar alpha\n"), std::string::npos);
  EXPECT_NE(this->header().find("list uchar int vertex_indices\n"), std::string::npos);
}

TEST_F(WritePly, IsTheSameForAllBlocks)
{
  const StreamMesh mesh = streamWithColumns();
  this->writeAsPly(mesh);
  const std::string expected = readFile(this->Folder / "out.ply");
  for (const std::int64_t blockCells : { 1, 100, 100000 })
  {
    MemorySource source(mesh, blockCells);
    writeMesh(source, this->Folder / "again.ply");
    EXPECT_TRUE(readFile(this->Folder / "again.ply") == expected);
  }
}

TEST_F(WritePly, NamesPropertiesOfOtherColumns)
{
  StreamMesh mesh = toStream(sphere(1));
  const auto add = [&mesh](const char* name, ScalarType type, int components) {
    mesh.vertexColumns.push_back(randomColumn({ name, type, components }, mesh.vertices(), 6));
  };
  add("two words", ScalarType::Float32, 2);
  add("x", ScalarType::Float32, 1);
  add("Normals", ScalarType::Float32, 1);
  add("two_words_1", ScalarType::Float32, 1);
  add("OriginalId", ScalarType::Int64, 1);
  mesh.cellColumns.push_back(
    randomColumn({ "vertex_indices", ScalarType::Int32, 1 }, mesh.cells(), 7));
  const std::vector<std::string> renamed{
    "The column 'two words' is called 'two_words_1' in the file.",
    "The column 'x' is called 'x_1' in the file.",
    "The column 'vertex_indices' is called 'vertex_indices_1' in the file.",
    "The column 'two_words_1' of 2 components comes back as the columns 'two_words_1_0' to "
    "'two_words_1_1'."
  };
  EXPECT_EQ(this->writeAsPly(mesh), renamed);
  const ReadMesh back = importWhole(this->Folder / "out.ply");
  // Each column has its own values under a name that no other one had.
  const std::vector<std::pair<std::string, std::pair<int, int>>> expected{
    { "two_words_1_0", { 0, 0 } }, { "two_words_1_1", { 0, 1 } }, { "x_1", { 1, 0 } },
    { "Normals", { 2, 0 } }, { "two_words_1", { 3, 0 } }, { "OriginalId", { 4, 0 } }
  };
  ASSERT_EQ(back.vertexColumns.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const auto& [name, of] = expected[i];
    EXPECT_EQ(back.vertexColumns[i].spec.name, name);
    for (std::int64_t v = 0; v < mesh.vertices(); v++)
    {
      EXPECT_EQ(back.vertexColumns[i].value(v), mesh.vertexColumns[of.first].value(v, of.second));
    }
  }
  EXPECT_EQ(back.vertexColumns.back().spec.type, ScalarType::Float64);
}

TEST_F(WritePly, KeepsFormerNumbersUnderAnotherName)
{
  StreamMesh mesh = toStream(sphere(1));
  std::vector<std::int64_t> thousands;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    thousands.push_back(1000 * v);
  }
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>("OriginalId", thousands));
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>("OriginalId_1", thousands));
  mesh.cellColumns.push_back(
    randomColumn({ "OriginalCellId", ScalarType::Int64, 1 }, mesh.cells(), 7));
  this->writeAsPly(mesh);
  const ConversionReport report = convert(this->Folder / "out.ply", this->Folder / "back.vsm");
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_NE(
    report.notes[0].find("'OriginalId' of the input is called 'OriginalId_2'"), std::string::npos);
  EXPECT_NE(report.notes[1].find("'OriginalCellId_1'"), std::string::npos);
  const StreamMesh back = collect(*VsmReader(this->Folder / "back.vsm").source());
  const auto column = [&back](const char* name, ScalarType type) -> const Column& {
    return back.vertexColumns.at(findColumn(back.vertexColumns, { name, type, 1 }));
  };
  const Column& own = column("OriginalId", ScalarType::Int64);
  const Column& former = column("OriginalId_2", ScalarType::Float64);
  for (std::int64_t v = 0; v < back.vertices(); ++v)
  {
    EXPECT_EQ(former.value(v), 1000.0 * own.value(v));
  }
  EXPECT_EQ(column("OriginalId_1", ScalarType::Float64).bytes, former.bytes);
  EXPECT_GE(findColumn(back.cellColumns, { "OriginalCellId", ScalarType::Int64, 1 }), 0);
}

TEST_F(WritePly, SaysWhatComesBackAsSeveralColumns)
{
  StreamMesh mesh = toStream(sphere(0));
  for (const ColumnSpec& spec :
    { ColumnSpec{ "Normals", ScalarType::Float32, 3 }, ColumnSpec{ "Colors", ScalarType::UInt8, 4 },
      ColumnSpec{ "one", ScalarType::Int8, 1 }, ColumnSpec{ "flow", ScalarType::Float64, 3 } })
  {
    mesh.vertexColumns.push_back(randomColumn(spec, mesh.vertices(), 3));
  }
  EXPECT_EQ(this->writeAsPly(mesh),
    std::vector<std::string>{ "The column 'flow' of 3 components comes back as the columns "
                              "'flow_0' to 'flow_2'." });
}

TEST_F(WritePly, SaysWhatWasRounded)
{
  StreamMesh mesh = toStream(sphere(0));
  std::vector<std::int64_t> exact(mesh.vertices(), std::int64_t(1) << 53);
  exact[1] = std::numeric_limits<std::int64_t>::min();
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>("exact", exact));
  exact[2] = std::numeric_limits<std::int64_t>::max();
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>("large", exact));
  std::vector<std::uint64_t> odd(mesh.vertices(), 3);
  odd[3] = std::numeric_limits<std::uint64_t>::max();
  mesh.vertexColumns.push_back(makeColumn<std::uint64_t>("odd", odd));
  const std::vector<std::string> notes = this->writeAsPly(mesh);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("column 'large' were rounded"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("column 'odd' were rounded"), std::string::npos) << notes[1];
}

/** A source that declares other counts than it has. */
class LyingSource : public MemorySource
{
public:
  LyingSource(const StreamMesh& mesh, std::int64_t vertices, std::int64_t cells)
    : MemorySource(mesh)
    , Lie(MemorySource::info())
  {
    this->Lie.vertices += vertices;
    this->Lie.cells += cells;
  }
  const StreamInfo& info() const override { return this->Lie; }

private:
  StreamInfo Lie;
};

TEST_F(WritePly, RefusesWhatItCannotHold)
{
  const auto refusal = [this](MeshSource& source, const std::string& name)
  {
    const std::string message = messageOf([&] { writeMesh(source, this->Folder / name); });
    EXPECT_EQ(this->Folder.entries(), 0) << message;
    return message;
  };
  const auto contains = [](const std::string& message, const std::string& part)
  { EXPECT_NE(message.find(part), std::string::npos) << message; };
  MemorySource good(toStream(sphere(1)));
  LyingSource gigantic(good.mesh(), std::int64_t(1) << 31, 0);
  contains(refusal(gigantic, "out.ply"), "2147483647 vertices");
  for (const auto& [vertices, cells] : { std::pair{ 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } })
  {
    LyingSource lying(good.mesh(), vertices, cells);
    contains(refusal(lying, "out.ply"), "cells of its info");
    LyingSource again(good.mesh(), vertices, cells);
    contains(messageOf([&] { writeMesh(again, this->Folder / "out.vtu"); }), "cells of its info");
    EXPECT_EQ(this->Folder.entries(), 0);
  }
  contains(refusal(good, "missing/out.ply"), "missing");
  const WriteMeshOptions cancelled{ .progress = [](double) { return false; } };
  EXPECT_THROW(writeMesh(good, this->Folder / "out.ply", cancelled), Cancelled);
  EXPECT_EQ(this->Folder.entries(), 0);
}

TEST_F(WritePly, IsAFormatOfConversion)
{
  StreamMesh mesh = streamWithColumns();
  mesh.vertexColumns.push_back(randomColumn({ "x", ScalarType::Int32, 1 }, mesh.vertices(), 8));
  write(this->Folder / "mesh.vsm", mesh);
  ConversionOptions options;
  options.order = StreamOrder::Keep;
  const ConversionReport report =
    convert(this->Folder / "mesh.vsm", this->Folder / "out.ply", options);
  EXPECT_EQ(importWhole(this->Folder / "out.ply").corners, mesh.corners);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("column 'x'"), std::string::npos) << report.notes[0];
  write(this->Folder / "tets.vsm", toStream(tetBox(3, 3, 3)));
  expectError([this] { convert(this->Folder / "tets.vsm", this->Folder / "tets.ply"); },
    "a .ply file holds no tetrahedra");
  EXPECT_FALSE(std::filesystem::exists(this->Folder / "tets.ply"));
}

} // namespace
} // namespace smg::testing
