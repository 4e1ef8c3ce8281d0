// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/ExternalSort.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <vector>

namespace smg::testing
{
namespace
{

struct Wide
{
  std::uint64_t key;
  std::uint64_t number;
  std::array<std::uint64_t, 30> rest;
};
struct ByKey
{
  bool operator()(const Wide& a, const Wide& b) const
  {
    return a.key != b.key ? a.key < b.key : a.number < b.number;
  }
};

std::ptrdiff_t openFiles()
{
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

template <class Less>
void expectSorted(std::int64_t count, std::int64_t memory, Less less)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory, {}, 0, 3);
  ExternalSort<std::uint64_t, Less> sort(workspace, memory, less);
  std::vector<std::uint64_t> expected(static_cast<std::size_t>(count));
  Random random(5);
  for (std::uint64_t& number : expected)
  {
    number = random.bits();
    sort.put(number);
  }
  EXPECT_EQ(sort.size(), count);
  sort.sort();
  std::sort(expected.begin(), expected.end(), less);
  std::vector<std::uint64_t> sorted;
  for (std::uint64_t number = 0; sort.next(number);)
  {
    sorted.push_back(number);
  }
  EXPECT_EQ(sorted, expected);
  std::uint64_t none = 0;
  EXPECT_FALSE(sort.next(none));
  EXPECT_LE(workspace.pool().peak(), memory + memory / 2);
}

} // namespace

TEST(ExternalSort, EqualsStdSortForAnyCount)
{
  constexpr std::int64_t Run = (1 << 20) / 8;
  for (const std::int64_t count : { std::int64_t(0), std::int64_t(1), std::int64_t(1024),
         std::int64_t(1025), Run - 1, Run, Run + 1, 5 * Run, 13 * Run + 7, 40 * Run + 3 })
  {
    SCOPED_TRACE(count);
    expectSorted(count, 1 << 20, std::less<std::uint64_t>());
  }
  expectSorted(3 * Run, 1 << 20, std::greater<std::uint64_t>());
  expectSorted(3 * Run, 8 << 20, std::less<std::uint64_t>());
}

TEST(ExternalSort, CanBeCancelledWhileRunsAreMerged)
{
  for (const int threads : { 1, 3 })
  {
    const TemporaryFolder folder;
    bool goesOn = true;
    Workspace workspace(
      folder.path(), Workspace::MinMemory, [&goesOn](double) { return goesOn; }, 0, threads);
    ExternalSort<std::uint64_t> sort(workspace, 1 << 20);
    for (std::uint64_t i = 0; i < 1000000; ++i)
    {
      sort.put(i * 7919 % 1000003);
    }
    sort.sort();
    std::uint64_t number = 0;
    ASSERT_TRUE(sort.next(number));
    goesOn = false;
    EXPECT_THROW(while (sort.next(number)){}, Cancelled) << threads;
  }
}

TEST(ExternalSort, ManyRunsNeedFewFilesAndLittleMemory)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  ExternalSort<Wide, ByKey> sort(workspace, 1 << 20);
  constexpr std::uint64_t Count = 800000; // 195 runs
  const std::ptrdiff_t before = openFiles();
  std::ptrdiff_t most = 0;
  Random random(6);
  for (std::uint64_t i = 0; i < Count; ++i)
  {
    Wide record{ random.bits() % 1000, i, {} };
    record.rest.fill(record.key * Count + i);
    sort.put(record);
    if (i % 4000 == 0)
    {
      most = std::max(most, openFiles() - before);
    }
  }
  sort.sort();
  EXPECT_LE(most, 40);
  Wide last{};
  std::uint64_t count = 0;
  for (Wide record{}; sort.next(record); last = record, ++count)
  {
    ASSERT_TRUE(count == 0 || ByKey()(last, record));
    ASSERT_EQ(record.rest[29], record.key * Count + record.number);
  }
  EXPECT_EQ(count, Count);
  EXPECT_LE(workspace.pool().peak(), 3 << 19);
}

} // namespace smg::testing
