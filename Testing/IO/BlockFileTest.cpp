// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <sys/resource.h>

namespace smg::testing
{
namespace
{

using Bytes = std::vector<std::byte>;

std::span<const std::byte> bytesOf(const auto& values)
{
  return std::as_bytes(std::span(values));
}

Bytes readFile(const std::filesystem::path& path)
{
  Bytes bytes(std::filesystem::file_size(path));
  std::ifstream(path, std::ios::binary)
    .read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
  return bytes;
}

void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
  std::ofstream(path, std::ios::binary)
    .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

void writeByte(const std::filesystem::path& path, std::size_t place, std::byte value)
{
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(std::streamoff(place));
  file.put(std::to_integer<char>(value));
}

/** The columns of a block: of doubles x 3 and integers, smooth or random, and an opaque one. */
struct TestBlock
{
  TestBlock(std::int64_t rows, bool smooth, std::uint64_t seed)
  {
    Random random(seed);
    for (std::int64_t i = 0; i < rows; i++)
    {
      for (int k = 0; k < 3; k++)
      {
        this->Points.push_back(smooth ? 0.5 * double(i) : random.uniform());
      }
      this->Numbers.push_back(std::int32_t(smooth ? i : std::int64_t(random.bits() >> 33)));
    }
    this->Opaque.resize(rows / 3 + seed % 5, std::byte(seed));
  }
  std::array<std::span<const std::byte>, 3> columns() const
  {
    return { bytesOf(this->Points), bytesOf(this->Numbers), this->Opaque };
  }

  std::vector<double> Points;
  std::vector<std::int32_t> Numbers;
  Bytes Opaque;
};

std::vector<TableSpec> testTables()
{
  const std::vector<ColumnSpec> columns{ { "points", ScalarType::Float64, 3 },
    { "numbers", ScalarType::Int32, 1 }, { "opaque", ScalarType::UInt8, 0 } };
  return { { "first", columns }, { "second", columns } };
}

/** Blocks of different sizes, alternating between both tables. */
std::vector<TestBlock> testBlocks(const std::vector<std::int64_t>& sizes)
{
  std::vector<TestBlock> blocks;
  for (const std::int64_t size : sizes)
  {
    blocks.emplace_back(size, blocks.size() % 3 != 0, blocks.size());
  }
  return blocks;
}

void writeBlocks(const std::filesystem::path& path, Codec codec,
  const std::vector<TestBlock>& blocks, IoStatistics* statistics = nullptr)
{
  BlockFileWriter writer(path, testTables(), codec, statistics);
  for (std::size_t b = 0; b < blocks.size(); b++)
  {
    writer.append(int(b % 2), std::int64_t(blocks[b].Numbers.size()), blocks[b].columns());
  }
  writer.finish(nlohmann::json({ { "name", "test" }, { "count", blocks.size() } }).dump());
}

void expectBlock(BlockFileReader& reader, int table, std::int64_t block, const TestBlock& expected)
{
  const auto columns = expected.columns();
  ASSERT_EQ(reader.blockRows(table, block), std::int64_t(expected.Numbers.size()));
  for (int c = 0; c < 3; c++)
  {
    Bytes bytes(reader.columnBytes(table, block, c));
    reader.read(table, block, c, bytes);
    ASSERT_TRUE(std::ranges::equal(bytes, columns[c])) << "block " << block << " column " << c;
  }
}

/** Opens and reads the whole file. */
void readAll(const std::filesystem::path& path)
{
  BlockFileReader reader(path);
  for (int table = 0; table < int(reader.tables().size()); table++)
  {
    for (std::int64_t block = 0; block < reader.blocks(table); block++)
    {
      for (int c = 0; c < int(reader.tables()[table].columns.size()); c++)
      {
        Bytes bytes(reader.columnBytes(table, block, c));
        reader.read(table, block, c, bytes);
      }
    }
  }
}

class BlockFileCodecs : public ::testing::TestWithParam<Codec>
{
protected:
  TemporaryFolder Folder;
  std::filesystem::path Path = Folder / "file.blocks";
};

INSTANTIATE_TEST_SUITE_P(
  All, BlockFileCodecs, ::testing::Values(Codec::None, Codec::Lz4, Codec::Zstd));

TEST_P(BlockFileCodecs, GivesBackEveryBlockInAnyOrder)
{
  const std::vector<TestBlock> blocks =
    testBlocks({ 1, 5000, 0, 4096, 70000, 3, 4097, 12, 1000, 999, 40000, 1 });
  IoStatistics statistics;
  writeBlocks(this->Path, GetParam(), blocks, &statistics);
  EXPECT_EQ(this->Folder.entries(), 1);
  EXPECT_EQ(statistics.bytesWritten, std::int64_t(std::filesystem::file_size(this->Path)));

  BlockFileReader reader(this->Path);
  EXPECT_EQ(reader.codec(), GetParam());
  EXPECT_EQ(reader.tables(), testTables());
  EXPECT_EQ(nlohmann::json::parse(reader.header()).at("count"), blocks.size());
  const auto count = std::int64_t(blocks.size());
  for (const std::int64_t step : { 1, 5, 7, 11 })
  {
    for (std::int64_t i = 0; i < count; i++)
    {
      const std::int64_t b = i * step % count;
      expectBlock(reader, int(b % 2), b / 2, blocks[b]);
    }
  }
}

TEST_P(BlockFileCodecs, PrefetchChangesNothing)
{
  const std::vector<TestBlock> blocks = testBlocks(std::vector<std::int64_t>(60, 3000));
  writeBlocks(this->Path, GetParam(), blocks);
  BlockFileReader reader(this->Path);
  Random random(3);
  for (std::int64_t b = 0; b < 60; b++)
  {
    for (std::int64_t ahead = b; ahead < std::min<std::int64_t>(60, b + b % 14); ahead++)
    {
      reader.prefetch(int(ahead % 2), ahead / 2);
    }
    reader.prefetch(0, random.below(30));
    const std::int64_t chosen = b % 9 == 8 ? random.below(60) : b;
    expectBlock(reader, int(chosen % 2), chosen / 2, blocks[chosen]);
  }
}

TEST_P(BlockFileCodecs, NoticesEveryChangedByte)
{
  writeBlocks(this->Path, GetParam(), testBlocks({ 40, 30, 5 }));
  const Bytes good = readFile(this->Path);
  readAll(this->Path);
  for (std::size_t i = 0; i < good.size(); i++)
  {
    // Most of the front is zeros.
    if (i > 400 && i + 400 < 16384 && i % 97 != 0)
    {
      continue;
    }
    writeByte(this->Path, i, good[i] ^ std::byte(1U << i % 8));
    const std::string message = messageOf([&] { readAll(this->Path); });
    ASSERT_NE(message.find(this->Path.string()), std::string::npos) << "byte " << i;
    writeByte(this->Path, i, good[i]);
  }
  readAll(this->Path);
}

TEST_P(BlockFileCodecs, NoticesMissingAndAppendedBytes)
{
  writeBlocks(this->Path, GetParam(), testBlocks({ 40, 30, 5 }));
  const Bytes good = readFile(this->Path);
  for (std::size_t size = 0; size < good.size(); size += size < 100 ? 1 : 53)
  {
    writeFile(this->Path, std::span(good).first(size));
    ASSERT_NE(messageOf([&] { readAll(this->Path); }), "") << size;
  }
  writeFile(this->Path, std::span(good).first(good.size() - 1));
  expectError([&] { readAll(this->Path); }, "truncated");
  Bytes longer = good;
  longer.push_back(std::byte{});
  writeFile(this->Path, longer);
  expectError([&] { readAll(this->Path); }, "appended");
}

TEST(BlockFile, CompressesWhatCanBeCompressed)
{
  const TemporaryFolder folder;
  const std::vector<TestBlock> blocks(5, TestBlock(20000, true, 1));
  writeBlocks(folder / "none", Codec::None, blocks);
  const auto plain = std::filesystem::file_size(folder / "none");
  for (const Codec codec : { Codec::Lz4, Codec::Zstd })
  {
    writeBlocks(folder / "packed", codec, blocks);
    EXPECT_LT(3 * std::filesystem::file_size(folder / "packed"), plain);
  }
}

TEST(BlockFile, FindsTheBlockOfARow)
{
  const TemporaryFolder folder;
  writeBlocks(folder / "file", Codec::None, testBlocks({ 3, 1, 0, 1, 4, 1, 0, 1 }));
  const BlockFileReader reader(folder / "file");
  ASSERT_EQ(reader.rows(0), 7);
  ASSERT_EQ(reader.blocks(0), 4);
  const std::int64_t expected[] = { 0, 0, 0, 2, 2, 2, 2 };
  for (std::int64_t row = 0; row < 7; row++)
  {
    EXPECT_EQ(reader.blockOf(0, row), expected[row]);
  }
  EXPECT_EQ(reader.firstRow(0, 2), 3);
  expectError([&] { reader.blockOf(0, 7); }, "has no row 7");
  expectError([&] { reader.blockOf(0, -1); }, "has no row -1");
}

TEST(BlockFile, WithoutFinishNothingIsLeft)
{
  const TemporaryFolder folder;
  {
    BlockFileWriter writer(folder / "file", testTables(), Codec::Zstd);
    const TestBlock block(200000, false, 1);
    writer.append(0, 200000, block.columns());
    EXPECT_EQ(folder.entries(), 1);
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(BlockFile, ReplacesAFileInOneStep)
{
  const TemporaryFolder folder;
  writeBlocks(folder / "file", Codec::None, testBlocks({ 3 }));
  {
    BlockFileWriter writer(folder / "file", testTables(), Codec::None);
    EXPECT_EQ(BlockFileReader(folder / "file").rows(0), 3);
    writer.finish("{}");
  }
  EXPECT_EQ(BlockFileReader(folder / "file").rows(0), 0);
}

TEST(BlockFile, RefusesOtherFiles)
{
  const TemporaryFolder folder;
  expectError([&] { readAll(folder / "none"); }, "No such file or directory");
  expectError([&] { readAll(folder.path()); }, "not a regular file");
  EXPECT_FALSE(isBlockFile(folder / "none"));
  EXPECT_FALSE(isBlockFile(folder.path()));
  writeFile(folder / "text", bytesOf(std::string("this is no such file")));
  expectError([&] { readAll(folder / "text"); }, "does not begin with SMGBLOCK");
  EXPECT_FALSE(isBlockFile(folder / "text"));
  writeFile(folder / "empty", {});
  expectError([&] { readAll(folder / "empty"); }, "does not begin with SMGBLOCK");

  writeBlocks(folder / "file", Codec::None, testBlocks({ 3 }));
  EXPECT_TRUE(isBlockFile(folder / "file"));
  const Bytes good = readFile(folder / "file");
  Bytes other = good;
  other[8] = std::byte{ 77 };
  writeFile(folder / "file", other);
  expectError([&] { readAll(folder / "file"); }, "is of version 77");
  other = good;
  std::reverse(other.begin() + 12, other.begin() + 16);
  writeFile(folder / "file", other);
  expectError([&] { readAll(folder / "file"); }, "byte order");
}

TEST(BlockFile, RefusesColumnsThatDoNotFit)
{
  const TemporaryFolder folder;
  BlockFileWriter writer(folder / "file", testTables(), Codec::None);
  const TestBlock block(10, true, 1);
  auto columns = block.columns();
  expectError([&] { writer.append(0, 11, columns); }, "column 'points' has 240 bytes");
  expectError([&] { writer.append(2, 10, columns); }, "there is no table 2");
  expectError([&] { writer.append(0, 10, std::span(columns).first(2)); }, "of 2 columns");
  writer.append(0, 10, columns);
  expectError([&] { writer.finish('"' + std::string(20000, 'x') + '"'); }, "has room for");
  writer.finish("{}");
  BlockFileReader reader(folder / "file");
  Bytes bytes(239);
  expectError([&] { reader.read(0, 0, 0, bytes); }, "has 240 bytes, not 239");
  expectError([&] { reader.read(0, 1, 0, bytes); }, "there is no block 1");
}

TEST(BlockFile, TellsOfWritesThatFail)
{
  const TemporaryFolder folder;
  expectError([&] { writeBlocks(folder / "no" / "file", Codec::None, {}); }, "cannot be created");

  // A limit on the size of files acts like a full disk: a write fails.
  struct rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit small = before;
  small.rlim_cur = 3 << 20;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = messageOf([&]
    { writeBlocks(folder / "file", Codec::None, std::vector(20, TestBlock(20000, false, 1))); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message,
    (folder / "file").string() +
      ": cannot be written: File too large; raise the limit of the process (ulimit -f), or choose "
      "another file system.");
  EXPECT_EQ(folder.entries(), 0);
}

} // namespace
} // namespace smg::testing
