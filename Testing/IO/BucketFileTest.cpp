// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BucketFile.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace smg::testing
{
namespace
{

std::vector<std::byte> randomBytes(Random& random, std::int64_t most)
{
  std::vector<std::byte> bytes(static_cast<std::size_t>(random.below(most)));
  std::ranges::generate(bytes, [&random] { return static_cast<std::byte>(random.bits()); });
  return bytes;
}

} // namespace

TEST(BucketFile, BucketsKeepTheirBytesInOrder)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  constexpr int Buckets = 7;
  BucketFile file(workspace, Buckets, 1 << 16);
  std::vector<std::vector<std::byte>> expected(Buckets);
  Random random(3);
  for (int i = 0; i < 3000; ++i)
  {
    const auto bucket = static_cast<int>(random.below(Buckets - 1)); // the last one stays empty
    // Some are longer than a chunk.
    const std::vector<std::byte> bytes = randomBytes(random, i % 100 == 0 ? 50000 : 300);
    file.append(bucket, bytes);
    auto& all = expected[static_cast<std::size_t>(bucket)];
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  // Twice: with the last chunks in memory, and in the file.
  for (int round = 0; round < 2; ++round)
  {
    for (int bucket = 0; bucket < Buckets; ++bucket)
    {
      EXPECT_EQ(file.bytes(bucket), std::ssize(expected[std::size_t(bucket)]));
      EXPECT_EQ(bytesOf(file, bucket), expected[std::size_t(bucket)]);
    }
    file.close();
  }
  EXPECT_GT(workspace.traffic().bytesWritten, 500000);
}

TEST(BucketFile, OnlyChunksAreInMemory)
{
  for (const int threads : { 1, 4 })
  {
    const TemporaryFolder folder;
    Workspace workspace(folder.path(), Workspace::MinMemory, {}, 0, threads);
    BucketFile file(workspace, 16, 1 << 18);
    const std::vector<std::byte> bytes(100000);
    for (int i = 0; i < 1000; ++i)
    {
      file.append(i % 16, bytes);
    }
    EXPECT_LE(workspace.pool().peak(), 1 << 18);
    file.close();
    EXPECT_EQ(workspace.pool().used(), 0);
  }
}

/** Units of any length, also those that the buffer holds only if nothing is fetched ahead. */
TEST(BucketFile, WhatIsFetchedAheadIsTheSame)
{
  for (const int threads : { 1, 2, 8 })
  {
    const TemporaryFolder folder;
    Workspace workspace(folder.path(), Workspace::MinMemory, {}, 0, threads);
    BucketFile file(workspace, 2);
    constexpr std::uint32_t Count = 1u << 20;
    for (std::uint32_t i = 0; i < Count; ++i)
    {
      file.put(0, i);
      file.put(1, ~i);
    }
    for (const std::size_t unit : { 4, 12, 100'000, 200'000 })
    {
      const std::int64_t before = workspace.pool().used();
      BucketFile::Reader reader(file), other(file, 1);
      EXPECT_LE(workspace.pool().used() - before, 2 * std::int64_t(BucketFile::ChunkBytes));
      std::uint32_t next = 0, second = 0;
      for (std::size_t bytes = unit; next < Count; bytes = bytes == unit ? 4 : unit)
      {
        const std::size_t size = std::min(bytes, std::size_t(Count - next) * 4);
        for (auto part = reader.next(size, size); !part.empty(); part = part.subspan(4), ++next)
        {
          ASSERT_EQ(std::memcmp(part.data(), &next, 4), 0) << next << ", " << threads;
          ASSERT_TRUE(other.get(second));
          ASSERT_EQ(second, ~next);
        }
      }
      EXPECT_TRUE(reader.next(4).empty());
      EXPECT_FALSE(other.get(second));
    }
    BucketFile::Reader abandoned(file);
    EXPECT_FALSE(abandoned.next(4).empty());
  }
}

TEST(BucketFile, LittleDataNeedsNoFile)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  BucketFile file(workspace);
  file.put(0, 17);
  EXPECT_EQ(bytesOf(file).size(), sizeof(int));
  EXPECT_EQ(workspace.traffic().bytesWritten, 0);
}

TEST(BucketFile, ReadersKeepUnitsTogether)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  BucketFile file(workspace, 1, BucketFile::MinChunkBytes);
  for (std::int64_t i = 0; i < 10000; ++i)
  {
    file.put(0, std::array<std::int64_t, 3>{ i, 2 * i, 3 * i });
  }
  // 24 does not divide the bytes of the buffer.
  BucketFile::Reader reader(file, 0, 1000);
  std::int64_t count = 0;
  for (auto part = reader.next(24, 240); !part.empty(); part = reader.next(24, 240))
  {
    ASSERT_EQ(part.size() % 24, 0u);
    ASSERT_LE(part.size(), 240u);
    for (; !part.empty(); part = part.subspan(24), ++count)
    {
      std::array<std::int64_t, 3> record{};
      std::memcpy(record.data(), part.data(), 24);
      ASSERT_EQ(record, (std::array<std::int64_t, 3>{ count, 2 * count, 3 * count }));
    }
  }
  EXPECT_EQ(count, 10000);
}

TEST(RecordFile, ReadsRecordsOneByOneAndInSpans)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  RecordFile<std::uint32_t> file(workspace);
  for (std::uint32_t i = 0; i < 200000; ++i)
  {
    file.put(i);
  }
  EXPECT_EQ(file.size(), 200000);
  RecordFile<std::uint32_t>::Reader reader(file);
  std::uint32_t one = 0;
  std::vector<std::uint32_t> some(99999);
  ASSERT_TRUE(reader.next(one));
  ASSERT_TRUE(reader.next(one));
  EXPECT_EQ(one, 1u);
  ASSERT_TRUE(reader.next(some));
  EXPECT_EQ(some.front(), 2u);
  EXPECT_EQ(some.back(), 100000u);
  ASSERT_TRUE(reader.next(std::span(some).first(99999)));
  EXPECT_EQ(some.back(), 199999u);
  EXPECT_FALSE(reader.next(one));
}

} // namespace smg::testing
