// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Relabelling.h"

#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

namespace smg::testing
{
namespace
{

struct Row
{
  std::uint64_t number;
  std::uint64_t square;
};

void put(RowTable& table, std::uint64_t number, std::uint64_t square)
{
  const Row row{ number, square };
  table.put(static_cast<std::uint32_t>(number), std::as_bytes(std::span(&row, 1)));
}

/** Puts all numbers, those of three twice, but those after them never. */
void expectRows(std::int64_t count, std::int64_t memory)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(7));
  RowTable table(workspace, count, sizeof(Row), memory);
  for (const std::uint32_t number : numbers)
  {
    if (number % 3 == 0)
    {
      put(table, number, 0);
    }
    if (number % 3 != 1)
    {
      put(table, number, std::uint64_t(number) * number);
    }
  }
  table.close();
  for (std::int64_t next = 0; next < count;)
  {
    const std::span<const std::byte> bytes = table.read(next, 1000);
    ASSERT_FALSE(bytes.empty());
    ASSERT_LE(bytes.size(), 1000 * sizeof(Row));
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Row), ++next)
    {
      Row row{};
      std::memcpy(&row, &bytes[at], sizeof(row));
      const auto number = static_cast<std::uint64_t>(next);
      ASSERT_EQ(row.number, number % 3 == 1 ? UINT64_MAX : number);
      ASSERT_EQ(row.square, number % 3 == 1 ? UINT64_MAX : number * number);
    }
  }
  EXPECT_LE(workspace.pool().peak(),
    memory + std::max<std::int64_t>(memory / 3, table.buckets() * std::int64_t(4096)) + (1 << 18));
}

} // namespace

TEST(RowTable, BringsRowsIntoOrderInOneBucket)
{
  expectRows(10000, 1 << 20);
}

TEST(RowTable, BringsRowsIntoOrderInManyBuckets)
{
  expectRows(300000, 1 << 18);
}

TEST(RowTable, HasNoRowsOfNothing)
{
  expectRows(0, 1 << 18);
}

} // namespace smg::testing
