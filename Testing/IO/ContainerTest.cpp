// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmWriter.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>

namespace smg::testing
{
namespace
{

class Container : public ::testing::Test
{
protected:
  TemporaryFolder Folder;
  std::filesystem::path Path = Folder / "mesh.vsm";
};

TEST_F(Container, GivesBackTheStream)
{
  for (const bool single : { false, true })
  {
    for (const IndexedTestMesh& mesh :
      { grid(90, 110, 0.1), tetBox(11, 12, 13, 0.1), disjointUnion(torus(20, 30), sphere(2)) })
    {
      const StreamMesh stream = testStream(mesh, single);
      for (const std::int64_t blockCells : { 1, 777, 1000000 })
      {
        for (const bool sayFinal : { true, false })
        {
          write(this->Path, stream, { single, sayFinal, blockCells });
          const VsmReader reader(this->Path);
          EXPECT_EQ(reader.info().doublePositions, !single);
          expectSame(collect(*reader.source()), stream);
          EXPECT_EQ(this->Folder.entries(), 1);
        }
      }
    }
  }
}

TEST_F(Container, EveryCodecGivesBackTheStream)
{
  const StreamMesh stream = testStream(tetBox(20, 10, 10, 0.1));
  for (const Codec codec : { Codec::None, Codec::Lz4, Codec::Zstd })
  {
    write(this->Path, stream, { .codec = codec });
    const VsmReader reader(this->Path);
    EXPECT_EQ(reader.codec(), codec);
    expectSame(collect(*reader.source()), stream);
    EXPECT_EQ(reader.storedBytes(), std::int64_t(std::filesystem::file_size(this->Path)));
  }
}

TEST_F(Container, MeasuresTheStream)
{
  const StreamMesh stream = testStream(shuffled(torus(60, 70)));
  const std::vector<std::int64_t> last = lastCellsOf(stream);
  std::int64_t width = 0;
  std::int64_t span = 0;
  std::int64_t introduced = 0;
  double sum = 0;
  std::int64_t finals = 0;
  for (std::int64_t c = 0; c < stream.cells(); c++)
  {
    const auto [least, most] =
      std::minmax({ stream.corners[3 * c], stream.corners[3 * c + 1], stream.corners[3 * c + 2] });
    span = std::max(span, most - least);
    introduced = std::max(introduced, most + 1);
    width = std::max(width, introduced - finals);
    sum += double(introduced - finals);
    finals += std::count(last.begin(), last.end(), c);
  }
  for (const bool sayFinal : { true, false })
  {
    const StreamInfo written = write(this->Path, stream, { .sayFinal = sayFinal });
    const VsmReader reader(this->Path);
    for (const StreamInfo& info : { written, reader.info() })
    {
      EXPECT_EQ(info.vertices, stream.vertices());
      EXPECT_EQ(info.cells, stream.cells());
      EXPECT_EQ(info.width, width);
      EXPECT_EQ(info.span, span);
      for (int k = 0; k < 6; k++)
      {
        const int sign = k % 2 == 0 ? 1 : -1;
        double bound = std::numeric_limits<double>::infinity();
        for (std::int64_t v = 0; v < stream.vertices(); v++)
        {
          bound = std::min(bound, sign * stream.positions[3 * v + k / 2]);
        }
        EXPECT_EQ(info.bounds[k], sign * bound);
      }
    }
    EXPECT_DOUBLE_EQ(reader.meanWidth(), sum / double(stream.cells()));
    EXPECT_EQ(nlohmann::json::parse(reader.header()).at("width"), width);
  }
}

TEST_F(Container, SaysExactlyWhichVerticesAreFinal)
{
  const StreamMesh stream = testStream(grid(150, 160));
  const std::vector<std::int64_t> last = lastCellsOf(stream);
  for (const bool sayFinal : { true, false })
  {
    write(this->Path, stream, { .sayFinal = sayFinal });
    VsmReader reader(this->Path);
    const auto source = reader.source({}, {});
    MeshBlock block;
    std::int64_t blocks = 0;
    while (source->next(block))
    {
      const std::int64_t end = block.firstCell + std::int64_t(block.corners.size()) / 3;
      const auto alive =
        std::find_if(last.begin(), last.end(), [end](std::int64_t cell) { return cell >= end; });
      EXPECT_EQ(block.finalized, alive - last.begin());
      EXPECT_TRUE(block.vertexColumns.empty());
      blocks++;
    }
    EXPECT_EQ(blocks, reader.cellBlocks());
    EXPECT_GT(blocks, 2);
    std::vector<std::int64_t> read(last.size() - 100);
    reader.readLastCells(50, read);
    EXPECT_TRUE(std::equal(read.begin(), read.end(), last.begin() + 50));
  }
}

TEST_F(Container, OnlyTheNamedColumnsAreRead)
{
  const StreamMesh stream = testStream(sphere(3));
  write(this->Path, stream);
  VsmReader reader(this->Path);
  const auto source = reader.source({ "vertex int8", "vertex float32" }, { "cell colours" });
  const StreamMesh some = collect(*source);
  expectSame(some.vertexColumns, { stream.vertexColumns[0], stream.vertexColumns[8] });
  expectSame(some.cellColumns, { stream.cellColumns[1] });
  expectError([&] { reader.source({ "none" }, {}); }, "has no vertex column 'none'; it has 'vert");
  expectError([&] { reader.source({}, { "vertex int8" }); }, "has no cell column");

  MeshPiece piece;
  reader.selectColumns({ "vertex float32" }, {});
  reader.readPiece(3, 30, piece);
  ASSERT_EQ(piece.vertexColumns.size(), 1U);
  EXPECT_EQ(piece.vertexColumns[0].spec.name, "vertex float32");
  EXPECT_TRUE(piece.cellColumns.empty());

  Column column;
  reader.readVertexColumn("vertex int64", 7, 20, column);
  for (int i = 0; i < 20; i++)
  {
    EXPECT_EQ(column.value(i), stream.vertexColumns[6].value(7 + i));
  }
  expectError([&] { reader.readVertexColumn("vertex int64", -1, 3, column); }, "has no 3 vertices");
}

/** A block of two triangles around vertices 0 to 3. */
MeshBlock twoTriangleBlock()
{
  MeshBlock block;
  block.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5 };
  block.corners = { 0, 1, 2, 1, 3, 2 };
  block.finalized = 4;
  return block;
}

TEST_F(Container, RefusesWhatIsNoStream)
{
  const auto append = [this](const auto& change)
  {
    return [this, change]
    {
      MeshBlock block = twoTriangleBlock();
      change(block);
      StreamInfo info;
      info.doublePositions = false;
      VsmWriter writer(this->Path, info);
      writer.append(block);
      writer.finish();
    };
  };
  append([](MeshBlock&) {})();
  EXPECT_EQ(VsmReader(this->Path).info().width, 3);
  std::filesystem::remove(this->Path);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectError(
    append([&](MeshBlock& b) { b.positions[4] = nan; }), "coordinate 1 of vertex 1 is nan");
  expectError(append([&](MeshBlock& b) { b.positions[4] = 1e300; }), "single precision");
  expectError(append([&](MeshBlock& b) { b.positions[4] = 0.1; }), "single precision");
  expectError(append([](MeshBlock& b) { b.corners[2] = -1; }), "which does not exist");
  expectError(append([](MeshBlock& b) { b.corners[2] = 3; }), "before any cell uses vertex 2");
  expectError(append([](MeshBlock& b) { b.positions.resize(9); }), "which is not defined yet");
  expectError(append([](MeshBlock& b) { b.positions.resize(10); }), "incomplete");
  expectError(append([](MeshBlock& b) { b.corners.resize(5); }), "incomplete");
  expectError(append(
                [](MeshBlock& b)
                {
                  b.corners.resize(3);
                  b.finalized = 3;
                }),
    "no cell");
  expectError(append([](MeshBlock& b) { b.finalized = 5; }), "5 vertices are said to be final");
  expectError(append([](MeshBlock& b) { b.firstVertex = 1; }), "does not continue");
  expectError(append([](MeshBlock& b) { b = MeshBlock(); }), "without cells");
  expectError(
    [this]
    {
      VsmWriter writer(this->Path, {});
      MeshBlock block = twoTriangleBlock();
      writer.append(block);
      block.firstVertex = 4;
      block.firstCell = 2;
      writer.append(block);
    },
    "cell 2 uses vertex 0, which was said to be final");
  const ColumnSpec column{ "c", ScalarType::Int8, 1 };
  StreamInfo info;
  info.cellColumns = { column };
  expectError(
    [&]
    {
      VsmWriter writer(this->Path, info);
      writer.append(twoTriangleBlock());
    },
    "does not have 2 values of column 'c'");
  info.cellColumns.push_back(column);
  expectError([&] { VsmWriter(this->Path, info); }, "column 'c'");
  EXPECT_EQ(this->Folder.entries(), 0);
}

TEST_F(Container, RefusesDamagedFiles)
{
  write(this->Path, testStream(sphere(1)));
  const auto readAll = [this]
  {
    VsmReader reader(this->Path);
    collect(*reader.source());
    MeshPiece piece;
    reader.readPiece(0, reader.info().cells, piece);
  };
  readAll();
  std::string good(std::filesystem::file_size(this->Path), ' ');
  std::ifstream(this->Path, std::ios::binary).read(good.data(), std::streamsize(good.size()));
  std::fstream file(this->Path, std::ios::binary | std::ios::in | std::ios::out);
  for (std::size_t i = 0; i < good.size(); i += i < 16384 ? 13 : 3)
  {
    const auto put = [&](char c)
    {
      file.seekp(std::streamoff(i));
      file.put(c).flush();
    };
    put(char(good[i] ^ 32));
    ASSERT_NE(messageOf(readAll).find(this->Path.string()), std::string::npos) << "byte " << i;
    put(good[i]);
  }
  readAll();
  std::filesystem::resize_file(this->Path, good.size() - 1);
  expectError(readAll, "truncated");
}

TEST_F(Container, RefusesOtherBlockFiles)
{
  BlockFileWriter(this->Path, {}, Codec::None).finish(R"({"kind": "something else"})");
  expectError([&] { VsmReader reader(this->Path); }, "not a mesh stream");
  BlockFileWriter(this->Path, {}, Codec::None).finish(R"({"kind": 5})");
  expectError([&] { VsmReader reader(this->Path); }, "not a mesh stream");
  BlockFileWriter(this->Path, {}, Codec::None).finish(R"({"kind": "mesh stream"})");
  expectError([&] { VsmReader reader(this->Path); }, "incomplete header");
  write(this->Path, testStream(sphere(0)));
  const std::string header = VsmReader(this->Path).header();
  BlockFileWriter(this->Path, {}, Codec::None).finish(header);
  expectError([&] { VsmReader reader(this->Path); }, "does not have the tables");
}

} // namespace
} // namespace smg::testing
