// SPDX-License-Identifier: BSD-3-Clause
// Files with right checksums whose numbers do not agree: each is refused when it is opened or read,
// by an error that names it in one line.
#include "IO/External/BlockFile.h"
#include "IO/External/Workspace.h"
#include "IO/Formats/Vsm/VsmBuffers.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/IO/RewrittenBlocks.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

class ContainerNumbers : public ::testing::Test
{
protected:
  ContainerNumbers()
  {
    const StreamMesh stream = testStream(grid(100, 90, 0.1));
    write(this->Sound, stream);
    BlockFileReader reader(this->Sound);
    this->Header = nlohmann::json::parse(reader.header());
    this->Tables = reader.tables();
  }

  /** Opens the file and reads all of it. */
  void readAll() const
  {
    VsmReader reader(this->Path);
    collect(*reader.source());
    MeshPiece piece;
    reader.readPiece(0, reader.info().cells, piece);
    reader.readPiece(reader.info().cells / 2, reader.info().cells, piece);
  }

  void expectRefused(const std::string& what) const
  {
    const std::string message = messageOf([this] { this->readAll(); });
    EXPECT_NE(message.find(this->Path.string()), std::string::npos) << what << ": " << message;
    EXPECT_TRUE(std::ranges::none_of(message, [](unsigned char c) { return c < 32 || c == 127; }))
      << what << ": " << message;
  }

  TemporaryFolder Folder;
  std::filesystem::path Sound = Folder / "sound.vsm", Path = Folder / "mesh.vsm";
  nlohmann::json Header;
  std::vector<TableSpec> Tables;
};

} // namespace

TEST_F(ContainerNumbers, OfTheHeaderAreComparedWithEachOther)
{
  rewrite(this->Sound, this->Path, this->Header.dump(), this->Tables);
  this->readAll();
  const std::int64_t vertices = this->Header["vertices"], width = this->Header["width"];
  const std::int64_t most = INT64_MAX;
  const nlohmann::json cases = nlohmann::json::array({ { "span", -1 }, { "span", vertices },
    { "span", 1LL << 62 }, { "span", most }, { "span", 18446744073709551615ULL }, { "span", 1.5 },
    { "span", 1e300 }, { "span", "7" }, { "span", nullptr }, { "width", 0 }, { "width", -5 },
    { "width", vertices + 1 }, { "width", 1LL << 62 }, { "width", 1e30 }, { "mean_width", -1 },
    { "mean_width", width + 1 }, { "mean_width", 1e300 }, { "mean_width", "a" },
    { "vertices", vertices + 1 }, { "vertices", -1 }, { "vertices", 0 }, { "vertices", 1e300 },
    { "vertices", most }, { "cells", 0 }, { "cells", -1 }, { "cells", most }, { "cells", 1.5 },
    { "bounds", { 0, 1, 0, 1, 0 } }, { "bounds", { 0, 1, 0, 1, 0, 1, 0 } },
    { "bounds", { 1, 0, 0, 1, 0, 1 } }, { "bounds", { 0, 1, 0, 1, 0, nullptr } },
    { "bounds", { { "a", 1 } } }, { "cell", "x\x1b[31m" }, { "cell", 3 },
    { "precision", "float16" }, { "precision", nullptr } });
  for (const nlohmann::json& one : cases)
  {
    nlohmann::json header = this->Header;
    header[one[0].get<std::string>()] = one[1];
    rewrite(this->Sound, this->Path, header.dump(), this->Tables);
    this->expectRefused(one.dump());
    header.erase(one[0].get<std::string>());
    rewrite(this->Sound, this->Path, header.dump(), this->Tables);
    this->expectRefused("without " + one[0].dump());
  }
}

TEST_F(ContainerNumbers, OfBlocksAreComparedWithEachOther)
{
  const auto last = static_cast<std::ptrdiff_t>(BlockFileReader(this->Sound).rows(3)) - 1;
  const auto set = [this](int column, std::ptrdiff_t row, std::int64_t value)
  {
    rewrite(this->Sound, this->Path, this->Header.dump(), this->Tables,
      [&](int table, int place, std::vector<std::byte>& bytes)
      {
        if (table == VsmFormat::Blocks && place == column)
        {
          std::memcpy(bytes.data() + row * std::ptrdiff_t(sizeof(value)), &value, sizeof(value));
        }
      });
    this->expectRefused(
      std::to_string(column) + ", row " + std::to_string(row) + ": " + std::to_string(value));
  };
  ASSERT_GE(last, 1);
  for (const std::int64_t value : { std::int64_t(-1), std::int64_t(1), INT64_MAX, INT64_MIN })
  {
    set(0, 0, value); // FirstVertex of the first block is 0
    set(0, last, value);
  }
  for (const std::int64_t value : { std::int64_t(-1), INT64_MAX, INT64_MIN })
  {
    set(1, 0, value); // Finalized
    set(1, last, value);
  }
  // What is final cannot be used later.
  set(1, 0, BlockFileReader(this->Sound).rows(VsmFormat::Vertices) / 2);
}

TEST_F(ContainerNumbers, ColumnsHaveNamesOfTheirOwn)
{
  for (const char* name : { "", "Position", "vertex int8", "GlobalIds" })
  {
    std::vector<TableSpec> tables = this->Tables;
    tables[VsmFormat::Vertices].columns[2].name = name;
    tables[VsmFormat::Isolated].columns[3].name = name;
    rewrite(this->Sound, this->Path, this->Header.dump(), tables);
    this->expectRefused(name);
  }
  // Whatever an error quotes is shown in one line.
  std::vector<TableSpec> tables = this->Tables;
  tables[VsmFormat::Vertices].columns[2].name = "a\x1b[31m\n\x9b\xff";
  tables[VsmFormat::Isolated].columns[3].name = "a\x1b[31m\n\x9b\xff";
  rewrite(this->Sound, this->Path, this->Header.dump(), tables);
  this->readAll();
  const std::string message =
    messageOf([this] { const auto source = VsmReader(this->Path).source({ "none" }, {}); });
  EXPECT_NE(message.find("a?[31m ??"), std::string::npos) << message;
}

// Wide rows are in small blocks, in each column of which a mesh has the same values.
TEST_F(ContainerNumbers, WideColumnsHaveSmallBlocks)
{
  for (const int components : { 1, 20, 100, 5000 })
  {
    StreamMesh stream = toStream(grid(40, 30, 0.1));
    stream.vertexColumns = { randomColumn(
      { "v", ScalarType::Float64, components }, stream.vertices(), 1) };
    stream.cellColumns = { randomColumn(
      { "c", ScalarType::Float32, components }, stream.cells(), 2) };
    write(this->Path, stream);
    VsmReader reader(this->Path);
    expectSame(collect(*reader.source()), stream);
    EXPECT_EQ(reader.cellBlocks() > 1, components > 20) << components;
    // The smallest memory of a conversion is enough.
    reader.requireBlocksWithin(std::int64_t(16) << 20);
    MeshPiece piece;
    reader.readPiece(100, 900, piece);
    EXPECT_EQ(piece.cellColumns[0].tuples(), 800U);
  }
}

// Cells that share no vertex: each block of cells introduces as many vertices as it has corners.
TEST_F(ContainerNumbers, LooseCellsHaveBlocksForTheLeastMemory)
{
  for (const CellType type : { CellType::Triangle, CellType::Tetrahedron })
  {
    for (const int ofVertices : { 0, 1, 8, 16, 24, 31, 33, 100 })
    {
      for (const int ofCells : { 0, 32 })
      {
        StreamMesh stream;
        stream.cellType = type;
        const std::int64_t corners = cornersOf(type) * 9000;
        stream.corners.resize(static_cast<std::size_t>(corners));
        std::iota(stream.corners.begin(), stream.corners.end(), std::int64_t(0));
        stream.positions.resize(static_cast<std::size_t>(3 * corners));
        const auto add = [](std::vector<Column>& columns, int components, std::int64_t tuples)
        {
          if (components > 0)
          {
            columns.push_back({ { "v", ScalarType::Float64, components }, {} });
            columns.back().resize(static_cast<std::size_t>(tuples));
          }
        };
        add(stream.vertexColumns, ofVertices, corners);
        add(stream.cellColumns, ofCells, 9000);
        write(this->Path, stream);
        const VsmReader reader(this->Path);
        EXPECT_NO_THROW(reader.requireBlocksWithin(Workspace::MinMemory))
          << ofVertices << " and " << ofCells;
        EXPECT_TRUE(reader.cellBlocks() == 2 || ofVertices > 8 || ofCells > 0) << ofVertices;
      }
    }
  }
}

// What is written can be opened: blocks grow with the number of columns and rows, or it is refused
// before anything is written.
TEST_F(ContainerNumbers, IndexesAreOfBlocksThatCanBeRead)
{
  constexpr std::int64_t Million = 1000000;
  for (const ScalarType type : { ScalarType::UInt8, ScalarType::Float64 })
  {
    for (const std::int64_t columns : { 1, 100, 1000, 4096 })
    {
      for (const std::int64_t vertices : { std::int64_t(0), Million / 50, 2 * Million, 20 * Million,
             1000 * Million, 4000 * Million })
      {
        StreamInfo info;
        info.vertices = vertices;
        info.cells = 2 * vertices;
        for (std::int64_t c = 0; c < columns; ++c)
        {
          info.vertexColumns.push_back({ "v" + std::to_string(c), type, 1 });
        }
        const auto index = [columns, vertices](std::int64_t rows)
        { return 16 * (vertices / rows * (columns + 2) + vertices / 2000); };
        const std::string what = std::to_string(columns) + " of " + std::to_string(vertices);
        const std::string error = messageOf(
          [&]
          {
            const VsmBlockRows rows(info, "a.vsm");
            EXPECT_LE(index(rows.vertices), MaxIndexBytes) << what;
          });
        // Not even the largest blocks.
        const bool isTooLarge = index(VsmFormat::BlockRows) > MaxIndexBytes;
        EXPECT_EQ(error.find("leave columns out") != std::string::npos, isTooLarge)
          << what << ' ' << error;
      }
    }
  }
}

TEST_F(ContainerNumbers, TheIndexCountsAsMemory)
{
  {
    BlockFileWriter writer(this->Path, { { "t", { { "a", ScalarType::UInt8, 1 } } } }, Codec::None);
    const std::byte row{};
    const std::span<const std::byte> column(&row, 1);
    for (int i = 0; i < 1000; ++i)
    {
      writer.append(0, 1, { &column, 1 });
    }
    writer.finish("{}");
  }
  const std::int64_t bytes = BlockFileReader(this->Path).indexBytes();
  EXPECT_GE(bytes, 1000 * indexBytesOfBlock(1));
  EXPECT_LE(bytes, 1000 * indexBytesOfBlock(1) + 100);
  const VsmReader reader(this->Sound);
  const std::int64_t index = BlockFileReader(this->Sound).indexBytes();
  expectError([&] { reader.requireBlocksWithin(index); }, "so many that reading it takes");
}

TEST_F(ContainerNumbers, LargeBlocksCountAsMemory)
{
  StreamMesh stream = toStream(grid(100, 90, 0.1));
  write(this->Path, stream);
  std::vector<TableSpec> tables = BlockFileReader(this->Path).tables();
  // A column of zeros, of which the file has as good as nothing.
  const ColumnSpec wide{ "wide", ScalarType::Float64, 1000 };
  tables[VsmFormat::Cells].columns.push_back(wide);
  const std::filesystem::path narrow = this->Folder / "narrow.vsm";
  std::filesystem::rename(this->Path, narrow);
  rewrite(narrow, this->Path, VsmReader(narrow).header(), tables, {}, wide);
  EXPECT_LT(std::filesystem::file_size(this->Path), 1U << 20);
  const VsmReader reader(this->Path);
  expectError([&] { reader.requireBlocksWithin(std::int64_t(16) << 20); }, "the memory limit is");
  reader.requireBlocksWithin(std::int64_t(1) << 30);
  ConversionOptions little;
  little.memoryLimit = std::int64_t(16) << 20;
  expectError([&] { openMesh(this->Path, little); }, "the memory limit is 16 MiB");
  expectError(
    [&] { convert(this->Path, this->Folder / "out.vsm", little); }, "the memory limit is 16 MiB");
}

} // namespace smg::testing
