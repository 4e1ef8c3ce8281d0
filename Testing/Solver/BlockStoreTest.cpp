// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/BlockStore.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <vector>

namespace smg::testing
{
namespace
{

std::vector<std::byte> filledBytes(std::size_t count, int value)
{
  return std::vector<std::byte>(count, static_cast<std::byte>(value));
}

std::vector<std::byte> readBlock(BlockStore& blocks, std::int64_t index)
{
  std::vector<std::byte> bytes(blocks.bytes(index));
  blocks.read(index, bytes);
  return bytes;
}

} // namespace

TEST(BlockStore, AreWrittenAndReadInAnyOrder)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  BlockStore blocks(folder.path() / "blocks", statistics);
  blocks.write(3, filledBytes(100, 3));
  blocks.write(0, filledBytes(50, 1));
  blocks.write(5, filledBytes(200, 5));
  EXPECT_EQ(blocks.willRead(3, 6), 5); // written later, so not next to each other
  EXPECT_EQ(readBlock(blocks, 5), filledBytes(200, 5));
  EXPECT_EQ(readBlock(blocks, 0), filledBytes(50, 1));
  EXPECT_EQ(readBlock(blocks, 3), filledBytes(100, 3));
  EXPECT_EQ(statistics.bytesWritten, 350);
  EXPECT_EQ(statistics.bytesRead, 350);
  EXPECT_EQ(folder.entries(), 0) << "the file has a name";
}

TEST(BlockStore, AreRewritten)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  BlockStore blocks(folder.path() / "blocks", statistics);
  blocks.write(0, filledBytes(100, 1));
  blocks.write(1, filledBytes(100, 2));
  blocks.write(0, filledBytes(60, 3));
  EXPECT_EQ(readBlock(blocks, 0), filledBytes(60, 3));
  blocks.write(0, filledBytes(300, 4));
  EXPECT_EQ(readBlock(blocks, 0), filledBytes(300, 4));
  EXPECT_EQ(readBlock(blocks, 1), filledBytes(100, 2));
}

TEST(BlockStore, HaveNoBytesBeforeTheyAreWritten)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  BlockStore blocks(folder.path() / "blocks", statistics);
  EXPECT_EQ(blocks.bytes(7), 0U);
  EXPECT_TRUE(readBlock(blocks, 7).empty());
  blocks.write(1, {});
  EXPECT_TRUE(readBlock(blocks, 1).empty());
  std::vector<std::byte> room(4);
  expectError([&] { blocks.read(1, room); }, "blocks");
}

} // namespace smg::testing
