// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Relabelling.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <vector>

namespace smg::testing
{
namespace
{

class RelabellingTest : public ::testing::Test
{
protected:
  /** Applies the numbers to a file of random ones and compares with a table in memory. */
  void expectReplaced(std::int64_t end, std::int64_t memory, int passes, std::size_t count)
  {
    Random random(9);
    std::vector<std::uint32_t> table(static_cast<std::size_t>(end), NoIndex);
    Relabelling numbers(this->Space, end, memory);
    for (std::int64_t i = 0; i < 2 * end; ++i)
    {
      const auto from = static_cast<std::uint32_t>(random.below(end));
      const auto to = static_cast<std::uint32_t>(random.bits());
      if (table[from] == NoIndex)
      {
        table[from] = to;
        numbers.put(from, to);
      }
    }
    EXPECT_EQ(numbers.passes(), passes);
    RecordFile<std::uint32_t> file(this->Space);
    std::vector<std::int64_t> expected;
    for (std::size_t i = 0; i < count * 40000; ++i)
    {
      const auto number = static_cast<std::uint32_t>(random.below(end));
      file.put(number);
      expected.push_back(table[number]);
    }
    std::vector<std::int64_t> replaced;
    numbers.apply(file, count,
      [&](std::span<const std::uint32_t> record)
      {
        ASSERT_EQ(record.size(), count);
        replaced.insert(replaced.end(), record.begin(), record.end());
      });
    EXPECT_EQ(replaced, expected);
  }

  TemporaryFolder Folder;
  Workspace Space{ this->Folder.path(), Workspace::MinMemory };
};

} // namespace

TEST_F(RelabellingTest, AnyNumberOfPassesEqualsATable)
{
  this->expectReplaced(100000, 400000, 1, 4);
  this->expectReplaced(100000, 399999, 2, 3);
  this->expectReplaced(100000, 40000, 10, 4);
  this->expectReplaced(99991, 4000, 100, 1);
  this->expectReplaced(1, 4, 1, 3);
}

TEST_F(RelabellingTest, LargestNumbersAndThoseNeverPut)
{
  // Tables for 2^32 - 1 numbers; the last table reaches beyond 32 bits.
  Relabelling numbers(this->Space, std::int64_t(NoIndex), std::int64_t(5) << 20);
  numbers.put(0, 7);
  numbers.put(NoIndex - 1, 8);
  EXPECT_EQ(numbers.passes(), 2);
  RecordFile<std::uint32_t> file(this->Space);
  for (const std::uint32_t number : { 0U, 1U, 2U, 3000000000U, NoIndex - 1, NoIndex - 2 })
  {
    file.put(number);
  }
  std::vector<std::uint32_t> replaced;
  numbers.apply(
    file, 1, [&](std::span<const std::uint32_t> number) { replaced.push_back(number.front()); });
  EXPECT_EQ(replaced, (std::vector<std::uint32_t>{ 7, NoIndex, NoIndex, NoIndex, 8, NoIndex }));
}

TEST_F(RelabellingTest, NothingIsPutOrReplaced)
{
  Relabelling empty(this->Space, 10, 100);
  RecordFile<std::uint32_t> file(this->Space);
  empty.apply(file, 3, [](std::span<const std::uint32_t>) { FAIL(); });
  Relabelling other(this->Space, 10, 4);
  file.put(3);
  std::uint32_t replaced = 0;
  other.apply(file, 1, [&](std::span<const std::uint32_t> number) { replaced = number.front(); });
  EXPECT_EQ(replaced, NoIndex);
}

TEST_F(RelabellingTest, MemoryIsBounded)
{
  this->expectReplaced(3000000, 1 << 20, 12, 4);
  EXPECT_LE(this->Space.pool().peak(), 7 << 20);
  EXPECT_EQ(this->Space.pool().used(), 0);
}

} // namespace smg::testing
