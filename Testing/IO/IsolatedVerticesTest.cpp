// SPDX-License-Identifier: BSD-3-Clause
#include "smg/VsmReader.h"

#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace smg::testing
{
namespace
{

void append(const IsolatedVertices& from, IsolatedVertices& to)
{
  to.ids.insert(to.ids.end(), from.ids.begin(), from.ids.end());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  for (std::size_t c = 0; c < to.columns.size(); ++c)
  {
    to.columns[c].bytes.insert(
      to.columns[c].bytes.end(), from.columns[c].bytes.begin(), from.columns[c].bytes.end());
  }
}

std::vector<Column> emptyColumnsLike(const std::vector<Column>& columns)
{
  std::vector<Column> empty;
  for (const Column& column : columns)
  {
    empty.push_back({ column.spec, {} });
  }
  return empty;
}

class IsolatedVerticesTest : public ::testing::Test
{
protected:
  /** Writes the stream; `between` is called with the writer after each block. */
  StreamInfo writeWith(const std::string& name, const auto& between, bool single = false)
  {
    MemorySource source(this->Mesh, 500);
    StreamInfo info = source.info();
    info.doublePositions = !single;
    VsmWriter writer(this->Folder / name, info);
    for (MeshBlock block; source.next(block);)
    {
      writer.append(block);
      between(writer);
    }
    return writer.finish();
  }

  /** Isolated vertices with random values of all columns. */
  IsolatedVertices some(std::int64_t count, std::int64_t firstId) const
  {
    IsolatedVertices vertices;
    vertices.ids.resize(static_cast<std::size_t>(count));
    std::iota(vertices.ids.begin(), vertices.ids.end(), firstId);
    Random random(static_cast<std::uint64_t>(firstId));
    for (std::int64_t i = 0; i < 3 * count; ++i)
    {
      vertices.positions.push_back(static_cast<float>(random.uniform(-1e6, 1e6)));
    }
    for (const Column& column : this->Mesh.vertexColumns)
    {
      vertices.columns.push_back(randomColumn(column.spec, count, 77));
    }
    return vertices;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh = testStream(torus(40, 20, 0.1), true);
};

TEST_F(IsolatedVerticesTest, ComeBackInChunks)
{
  for (const bool single : { false, true })
  {
    IsolatedVertices all;
    all.columns = emptyColumnsLike(this->Mesh.vertexColumns);
    this->writeWith(
      "mesh.vsm",
      [&](VsmWriter& writer)
      {
        const IsolatedVertices chunk = this->some(5000, std::int64_t(all.ids.size()) + 3);
        writer.isolated(chunk.ids, chunk.positions, chunk.columns);
        append(chunk, all);
      },
      single);
    VsmReader reader(this->Folder / "mesh.vsm");
    ASSERT_EQ(reader.isolatedVertices(), std::int64_t(all.ids.size()));
    ASSERT_GT(reader.isolatedVertices(), VsmFormat::BlockRows);
    IsolatedVertices back, chunk;
    back.columns = emptyColumnsLike(this->Mesh.vertexColumns);
    for (std::int64_t first = 0; first < reader.isolatedVertices(); first += 1000)
    {
      reader.readIsolated(
        first, std::min<std::int64_t>(1000, reader.isolatedVertices() - first), chunk);
      append(chunk, back);
    }
    EXPECT_EQ(back.ids, all.ids);
    EXPECT_EQ(back.positions, all.positions);
    expectSame(back.columns, all.columns);
  }
}

TEST_F(IsolatedVerticesTest, AreNoPartOfTheStream)
{
  const StreamInfo without = this->writeWith("without.vsm", [](VsmWriter&) {});
  const StreamInfo with = this->writeWith("with.vsm",
    [this](VsmWriter& writer)
    {
      const IsolatedVertices chunk = this->some(10, 3);
      writer.isolated(chunk.ids, chunk.positions, chunk.columns);
    });
  EXPECT_EQ(with.vertices, without.vertices);
  EXPECT_EQ(with.bounds, without.bounds);
  EXPECT_EQ(with.width, without.width);
  EXPECT_EQ(with.span, without.span);
  VsmReader reader(this->Folder / "with.vsm");
  VsmReader plain(this->Folder / "without.vsm");
  EXPECT_EQ(reader.header(), plain.header());
  EXPECT_EQ(plain.isolatedVertices(), 0);
  const StreamMesh stream = collect(*reader.source());
  EXPECT_EQ(stream.positions, this->Mesh.positions);
  EXPECT_EQ(stream.corners, this->Mesh.corners);
  expectSame(stream.vertexColumns, this->Mesh.vertexColumns);
}

TEST_F(IsolatedVerticesTest, HaveZerosWithoutColumns)
{
  this->writeWith("mesh.vsm",
    [](VsmWriter& writer)
    {
      const std::int64_t id = 7;
      const double position[] = { 1, 2, 3 };
      writer.isolated({ &id, 1 }, position);
    });
  VsmReader reader(this->Folder / "mesh.vsm");
  IsolatedVertices back;
  reader.readIsolated(0, 1, back);
  EXPECT_EQ(back.ids, std::vector<std::int64_t>{ 7 });
  EXPECT_EQ(back.positions, (std::vector<double>{ 1, 2, 3 }));
  ASSERT_EQ(back.columns.size(), this->Mesh.vertexColumns.size());
  for (const Column& column : back.columns)
  {
    EXPECT_EQ(column.bytes, std::vector<std::byte>(column.spec.tupleBytes()));
  }
}

/** A file of only the four mandatory tables, without the optional fifth. */
TEST_F(IsolatedVerticesTest, AreNoneInFilesWithoutTheTable)
{
  this->writeWith("new.vsm", [](VsmWriter&) {});
  {
    BlockFileReader in(this->Folder / "new.vsm");
    std::vector<TableSpec> tables = in.tables();
    tables.resize(VsmFormat::MinTables);
    BlockFileWriter out(this->Folder / "old.vsm", tables, Codec::Lz4);
    for (int table = 0; table < VsmFormat::MinTables; ++table)
    {
      for (std::int64_t block = 0; block < in.blocks(table); ++block)
      {
        std::vector<std::vector<std::byte>> columns(tables[std::size_t(table)].columns.size());
        for (std::size_t c = 0; c < columns.size(); ++c)
        {
          columns[c].resize(in.columnBytes(table, block, int(c)));
          in.read(table, block, int(c), columns[c]);
        }
        const std::vector<std::span<const std::byte>> spans(columns.begin(), columns.end());
        out.append(table, in.blockRows(table, block), spans);
      }
    }
    out.finish(in.header());
  }
  VsmReader reader(this->Folder / "old.vsm");
  EXPECT_EQ(reader.isolatedVertices(), 0);
  EXPECT_EQ(collect(*reader.source()).corners, this->Mesh.corners);
  IsolatedVertices none;
  reader.readIsolated(0, 0, none);
  EXPECT_TRUE(none.ids.empty());
}

TEST_F(IsolatedVerticesTest, StayWithAMeshThatIsWrittenAgain)
{
  this->writeWith("mesh.vsm",
    [this](VsmWriter& writer)
    {
      const IsolatedVertices chunk = this->some(1, 3);
      writer.isolated(chunk.ids, chunk.positions, chunk.columns);
    });
  VsmReader first(this->Folder / "mesh.vsm");
  const std::string kept = this->Mesh.vertexColumns[3].spec.name;
  const std::unique_ptr<MeshSource> source = first.source({ kept }, {});
  const auto copy = [&](VsmWriter& writer)
  { copyIsolated(this->Folder / "mesh.vsm", source->info(), writer); };
  writeVsm(*source, this->Folder / "again.vsm", { .add = copy });
  VsmReader again(this->Folder / "again.vsm");
  ASSERT_EQ(again.isolatedVertices(), first.isolatedVertices());
  IsolatedVertices before, after;
  first.readIsolated(0, first.isolatedVertices(), before);
  again.readIsolated(0, again.isolatedVertices(), after);
  EXPECT_EQ(after.ids, before.ids);
  EXPECT_EQ(after.positions, before.positions);
  ASSERT_EQ(after.columns.size(), 1U);
  EXPECT_EQ(after.columns[0].bytes, before.columns[3].bytes);
}

TEST_F(IsolatedVerticesTest, HaveTheValueOfAColumnThatSaysIt)
{
  this->writeWith("mesh.vsm",
    [this](VsmWriter& writer)
    {
      const IsolatedVertices chunk = this->some(1, 3);
      writer.isolated(chunk.ids, chunk.positions, chunk.columns);
    });
  const VsmReader first(this->Folder / "mesh.vsm");
  MemorySource source(this->Mesh, 500);
  StreamInfo info = source.info();
  for (ColumnSpec& spec : info.vertexColumns)
  {
    spec.isolated = 5;
  }
  EXPECT_EQ(info.vertexColumns, source.info().vertexColumns);
  VsmWriter writer(this->Folder / "again.vsm", info);
  for (MeshBlock block; source.next(block);)
  {
    writer.append(block);
  }
  copyIsolated(this->Folder / "mesh.vsm", info, writer);
  writer.finish();
  VsmReader again(this->Folder / "again.vsm");
  IsolatedVertices all;
  again.readIsolated(0, first.isolatedVertices(), all);
  ASSERT_FALSE(all.columns.empty());
  for (const Column& column : all.columns)
  {
    for (std::size_t i = 0; i < column.tuples(); ++i)
    {
      EXPECT_EQ(column.value(i), 5.0) << column.spec.name;
    }
  }
}

TEST_F(IsolatedVerticesTest, RefusesWhatCannotBeStored)
{
  const auto give = [this](std::int64_t id, double x, std::size_t coordinates, bool columns)
  {
    this->writeWith(
      "bad.vsm",
      [&](VsmWriter& writer)
      {
        const std::vector<double> position(coordinates, x);
        const std::vector<Column> few(columns ? 1 : 0);
        writer.isolated({ &id, 1 }, position, few);
      },
      true);
  };
  expectError([&] { give(-1, 0, 3, false); }, "negative");
  expectError([&] { give(1, 0.1, 3, false); }, "single precision");
  expectError([&] { give(1, std::numeric_limits<double>::infinity(), 3, false); }, "not finite");
  expectError([&] { give(1, 0, 2, false); }, "three coordinates");
  expectError([&] { give(1, 0, 3, true); }, "values of column");
  EXPECT_EQ(this->Folder.entries(), 0);
}

TEST_F(IsolatedVerticesTest, RefusesVerticesThatAreNotThere)
{
  this->writeWith("mesh.vsm", [](VsmWriter&) {});
  VsmReader reader(this->Folder / "mesh.vsm");
  IsolatedVertices chunk;
  expectError([&] { reader.readIsolated(0, 1, chunk); }, "no 1 isolated vertices");
  expectError([&] { reader.readIsolated(-1, 0, chunk); }, "isolated vertices");
}

} // namespace
} // namespace smg::testing
