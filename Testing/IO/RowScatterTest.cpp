// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/RowScatter.h"

#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace smg::testing
{
namespace
{

struct Row
{
  std::uint32_t number;
  std::uint64_t square;
};

void expectScattered(std::int64_t count, std::int64_t memory)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::LeastMemory);
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(7));
  RowScatter rows(workspace, count, sizeof(Row), memory);
  for (const std::uint32_t number : numbers)
  {
    const Row row{ number, std::uint64_t(number) * number };
    rows.put(number, std::as_bytes(std::span(&row, 1)));
  }
  std::uint32_t expected = 0;
  for (auto bytes = rows.next(1000); !bytes.empty(); bytes = rows.next(1000))
  {
    ASSERT_LE(bytes.size(), 1000 * sizeof(Row));
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Row), ++expected)
    {
      Row row{};
      std::memcpy(&row, &bytes[at], sizeof(row));
      ASSERT_EQ(row.number, expected);
      ASSERT_EQ(row.square, std::uint64_t(expected) * expected);
    }
  }
  EXPECT_EQ(expected, count);
}

} // namespace

TEST(RowScatter, BringsRowsIntoOrderInOneBucket)
{
  expectScattered(10000, 1 << 20);
}

TEST(RowScatter, BringsRowsIntoOrderInManyBuckets)
{
  expectScattered(300000, 1 << 18);
}

TEST(RowScatter, HasNoRowsOfNothing)
{
  expectScattered(0, 1 << 18);
}

} // namespace smg::testing
