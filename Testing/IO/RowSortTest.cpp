// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/ExternalSort.h"

#include "Testing/Support/Sanitized.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace smg::testing
{
namespace
{

struct Expected
{
  std::uint64_t key;
  std::uint64_t sequence;
};

/** Sorts random keys, many of them equal, with rows of `rowBytes` bytes. */
void expectSortedRows(std::int64_t count, std::size_t rowBytes, std::int64_t memory)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  Random random(1);
  std::vector<Expected> expected;
  {
    RowSort sort(workspace, memory, rowBytes);
    for (std::int64_t i = 0; i < count; ++i)
    {
      expected.push_back({ random.bits() >> (i % 2 == 0 ? 0 : 54), std::uint64_t(i) });
      std::byte* const row = sort.put(expected.back().key);
      std::memset(row, static_cast<int>(i), rowBytes);
      std::memcpy(row, &i, sizeof(i));
    }
    std::ranges::stable_sort(expected, {}, &Expected::key);
    sort.sort();
    EXPECT_EQ(sort.size(), count);
    RowSort::Row row;
    for (const Expected& next : expected)
    {
      std::uint64_t sequence = 0;
      ASSERT_TRUE(sort.next(row));
      std::memcpy(&sequence, row.bytes, sizeof(sequence));
      ASSERT_EQ(row.key, next.key);
      ASSERT_EQ(sequence, next.sequence);
      ASSERT_EQ(
        row.bytes[rowBytes - 1], rowBytes == 8 ? std::byte(sequence >> 56) : std::byte(sequence));
    }
    EXPECT_FALSE(sort.next(row));
    EXPECT_FALSE(sort.next(row));
    if (GrowsInPlace)
    {
      EXPECT_LE(workspace.pool().peak(), memory + 2 * std::int64_t(BucketFile::ChunkBytes));
    }
  }
  EXPECT_EQ(workspace.pool().used(), 0);
}

TEST(RowSort, SortsInMemory)
{
  expectSortedRows(0, 8, 1 << 20);
  expectSortedRows(1, 8, 1 << 20);
  expectSortedRows(5000, 12, 8 << 20);
}

TEST(RowSort, MergesRuns)
{
  expectSortedRows(60000, 100, 1 << 20);
  expectSortedRows(300000, 8, 2 << 20);
}

/** With rows of this size, two runs of two rows are merged at once: five levels of runs. */
TEST(RowSort, MergesLevelsOfRuns)
{
  expectSortedRows(101, 500000, 1 << 20);
}

TEST(RowSort, HasRowsOfAnySize)
{
  expectSortedRows(300, 100000, 1 << 20);
}

} // namespace
} // namespace smg::testing
