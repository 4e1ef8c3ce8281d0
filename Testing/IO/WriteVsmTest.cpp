// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Results/SourcePrefetch.h"
#include "Solver/Core/Workers.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

namespace smg::testing
{
namespace
{

constexpr std::int64_t CellsOfBlock = 100;

/** A mesh whose block `failing` cannot be read, and whose block `bad` cannot be written: its first
 * cell uses a vertex that does not exist. */
struct FaultySource : MemorySource
{
  explicit FaultySource(int failing = 0, int bad = 0)
    : MemorySource(toStream(torus(40, 20)), CellsOfBlock)
    , Failing(failing)
    , Bad(bad)
  {
  }
  bool next(MeshBlock& block) override
  {
    if (++this->Asked == this->Failing)
    {
      throw Error("the block cannot be read");
    }
    const bool isThere = MemorySource::next(block);
    if (this->Asked == this->Bad)
    {
      block.corners[0] = -1;
    }
    return isThere;
  }
  int Failing, Bad;
  int Asked = 0;
};

std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

} // namespace

TEST(SourcePrefetch, DeliversTheStreamForAnyNumberOfThreads)
{
  for (const int threads : { 1, 2, 3 })
  {
    FaultySource same;
    SourcePrefetch source(std::make_unique<FaultySource>(), threads);
    EXPECT_EQ(source.info().cells, same.info().cells);
    MeshBlock block, expected;
    int blocks = 0;
    for (; source.next(block); ++blocks)
    {
      ASSERT_TRUE(same.next(expected));
      EXPECT_EQ(block.firstCell, expected.firstCell);
      EXPECT_EQ(block.corners, expected.corners);
      EXPECT_EQ(block.positions, expected.positions);
    }
    EXPECT_FALSE(same.next(expected));
    EXPECT_FALSE(source.next(block));
    EXPECT_EQ(blocks, 16);
  }
}

TEST(SourcePrefetch, FailsWithTheBlockThatFails)
{
  for (const int threads : { 1, 2 })
  {
    SourcePrefetch source(std::make_unique<FaultySource>(3), threads);
    MeshBlock block;
    EXPECT_TRUE(source.next(block));
    EXPECT_TRUE(source.next(block));
    EXPECT_EQ(messageOf([&] { source.next(block); }), "the block cannot be read");
  }
}

class WriteVsm : public ::testing::Test
{
protected:
  std::string error(FaultySource source, int threads)
  {
    Workers workers(threads);
    const std::string message = messageOf(
      [&]
      {
        writeVsm(source, this->Folder / "a.vsm",
          { .codec = Codec::Lz4, .workers = &workers, .apart = true });
      });
    EXPECT_TRUE(std::filesystem::is_empty(this->Folder.path()));
    return message;
  }

  TemporaryFolder Folder;
};

TEST_F(WriteVsm, GivesTheSameBytesForAnyNumberOfThreads)
{
  FaultySource source;
  writeVsm(source, this->Folder / "expected.vsm", { .codec = Codec::Lz4 });
  const std::string expected = contentOf(this->Folder / "expected.vsm");
  EXPECT_GT(expected.size(), 10000U);
  for (const int threads : { 1, 2, 3, 8 })
  {
    for (const bool apart : { false, true })
    {
      Workers workers(threads);
      FaultySource again;
      writeVsm(again, this->Folder / "a.vsm",
        { .codec = Codec::Lz4, .workers = &workers, .apart = apart });
      EXPECT_EQ(contentOf(this->Folder / "a.vsm"), expected);
    }
  }
}

TEST_F(WriteVsm, ReportsTheFirstErrorOfTheStream)
{
  for (const int threads : { 1, 2, 4 })
  {
    EXPECT_EQ(this->error(FaultySource(5), threads), "the block cannot be read");
    EXPECT_TRUE(contains(this->error(FaultySource(0, 5), threads), "uses vertex -1"));
    // Block 6 cannot be read, while block 5 is being appended.
    EXPECT_TRUE(contains(this->error(FaultySource(6, 5), threads), "uses vertex -1"));
  }
}

TEST_F(WriteVsm, CanBeCancelled)
{
  for (const int threads : { 1, 2 })
  {
    Workers workers(threads);
    FaultySource source;
    int calls = 0;
    const auto stop = [&](double) { return ++calls < 4; };
    const WriteVsmOptions options{
      .codec = Codec::Lz4, .workers = &workers, .apart = true, .progress = stop
    };
    EXPECT_THROW(writeVsm(source, this->Folder / "a.vsm", options), Cancelled);
    EXPECT_EQ(calls, 4);
    EXPECT_TRUE(std::filesystem::is_empty(this->Folder.path()));
  }
}

} // namespace smg::testing
