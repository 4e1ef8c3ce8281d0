// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/PackedIntegers.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/SparseBlockFile.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <vector>

namespace smg::testing
{
namespace
{

using Bytes = std::vector<std::byte>;

/** Blocks of vertices and cells that a stream begins with. */
struct Before
{
  std::int64_t vertexBlocks, cellBlocks;

  std::int64_t vertices() const { return this->vertexBlocks * VsmFormat::BlockRows; }
  std::int64_t cells() const { return this->cellBlocks * VsmFormat::BlockRows; }
};

Bytes bytesOf(const std::vector<std::int64_t>& values)
{
  const auto bytes = std::as_bytes(std::span(values));
  return { bytes.begin(), bytes.end() };
}

std::vector<std::int64_t> numbersOf(const Bytes& bytes)
{
  std::vector<std::int64_t> values(bytes.size() / sizeof(std::int64_t));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/** A block of last cells whose first number, from 0, is larger by `shift`. */
Bytes laterCells(const Bytes& packed, std::int64_t rows, std::int64_t shift)
{
  std::vector<std::uint64_t> values(static_cast<std::size_t>(rows));
  EXPECT_TRUE(unpackIntegers(packed, values));
  values[0] = zigzag(unzigzag(values[0]) + shift);
  Bytes later;
  packIntegers(values, later);
  return later;
}

/** The table of blocks of a stream that begins with others. */
Bytes laterVertices(const Bytes& column, const Before& before)
{
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(before.cellBlocks));
  for (const std::int64_t number : numbersOf(column))
  {
    numbers.push_back(number + before.vertices());
  }
  return bytesOf(numbers);
}

/** Writes the stream with vertices and cells before its own, which cannot be read. */
void writeLater(const std::filesystem::path& from, const std::filesystem::path& to, Before before)
{
  BlockFileReader small(from);
  SparseBlockFile large(to, small.tables());
  for (int table = 0; table < std::ssize(small.tables()); ++table)
  {
    const bool ofVertices = table == VsmFormat::Vertices || table == VsmFormat::Last;
    const std::int64_t empty = ofVertices                  ? before.vertexBlocks
                               : table == VsmFormat::Cells ? before.cellBlocks
                                                           : 0;
    for (std::int64_t block = 0; block < empty; ++block)
    {
      large.addEmpty(table, VsmFormat::BlockRows);
    }
    for (std::int64_t block = 0; block < small.blocks(table); ++block)
    {
      std::int64_t rows = small.blockRows(table, block);
      std::vector<Bytes> columns(small.tables()[table].columns.size());
      for (int c = 0; c < std::ssize(columns); ++c)
      {
        columns[c].resize(small.columnBytes(table, block, c));
        small.read(table, block, c, columns[c]);
        columns[c] = table == VsmFormat::Blocks ? laterVertices(columns[c], before)
                     : table == VsmFormat::Last ? laterCells(columns[c], rows, before.cells())
                                                : columns[c];
      }
      rows += table == VsmFormat::Blocks ? before.cellBlocks : 0;
      large.add(table, rows, columns);
    }
  }
  nlohmann::json header = nlohmann::json::parse(small.header());
  header["vertices"] = header["vertices"].get<std::int64_t>() + before.vertices();
  header["cells"] = header["cells"].get<std::int64_t>() + before.cells();
  large.finish(header.dump());
}

void expectSame(const MeshPiece& a, const MeshPiece& b, const Before& before)
{
  EXPECT_EQ(b.firstCell, a.firstCell + before.cells());
  EXPECT_TRUE(std::ranges::equal(
    b.ids, a.ids, {}, [&before](std::int64_t id) { return id - before.vertices(); }));
  EXPECT_EQ(b.positions, a.positions);
  EXPECT_EQ(b.ghost, a.ghost);
  EXPECT_EQ(b.finalized, a.finalized);
  EXPECT_EQ(b.corners, a.corners);
  ASSERT_EQ(b.vertexColumns.size(), a.vertexColumns.size());
  EXPECT_EQ(b.vertexColumns[0].bytes, a.vertexColumns[0].bytes);
}

} // namespace

/** The pieces of a stream at whose end the numbers pass 2^31 or 2^32. */
TEST(LargeStream, HasPiecesOfTheSameBits)
{
  constexpr std::int64_t Half = (std::int64_t(1) << 31) / VsmFormat::BlockRows - 1;
  constexpr std::int64_t Whole = (std::int64_t(1) << 32) / VsmFormat::BlockRows - 1;
  const TemporaryFolder folder;
  StreamMesh mesh = toStream(grid(150, 140, 0.1));
  const std::vector<std::int64_t> numbers = mesh.originalIds;
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>("Number", numbers));
  {
    MemorySource source(mesh, 3000);
    VsmWriter writer(folder / "small.vsm", source.info());
    for (MeshBlock block; source.next(block);)
    {
      writer.append(block);
    }
    writer.finish();
  }
  VsmReader small(folder / "small.vsm");
  ASSERT_GT(small.info().vertices, 2 * VsmFormat::BlockRows);
  for (const Before& before : { Before{ Half, Whole }, Before{ Whole, Half } })
  {
    writeLater(folder / "small.vsm", folder / "large.vsm", before);
    VsmReader large(folder / "large.vsm");
    EXPECT_EQ(large.info().vertices, small.info().vertices + before.vertices());
    EXPECT_EQ(large.info().cells, small.info().cells + before.cells());
    small.selectColumns({ "Number" }, {});
    large.selectColumns({ "Number" }, {});
    MeshPiece expected, piece;
    const std::int64_t cells = small.info().cells;
    for (const std::int64_t begin : { std::int64_t(0), std::int64_t(8000), cells / 2, cells - 20 })
    {
      const std::int64_t end = std::min(cells, begin + 9000);
      small.readPiece(begin, end, expected);
      large.readPiece(before.cells() + begin, before.cells() + end, piece);
      expectSame(expected, piece, before);
    }
  }
}

} // namespace smg::testing
