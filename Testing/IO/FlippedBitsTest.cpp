// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/ExternalSort.h"
#include "IO/External/PagedArray.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Search/PagedSearch.h"
#include "Testing/Support/FlippedRead.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>

/** Scratch files of conversions: a wrong bit of any read is noticed. */

namespace smg::testing
{

TEST(FlippedBits, OfMergedRuns)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  expectNoticedFlips(10,
    [&]
    {
      constexpr std::uint64_t Count = 150000; // 1.2 MB: two runs
      ExternalSort<std::uint64_t> sort(workspace, 0);
      for (std::uint64_t i = 0; i < Count; ++i)
      {
        sort.put(i * 70001 % Count);
      }
      sort.sort();
      for (std::uint64_t value = 0; sort.next(value);)
      {
      }
    });
}

TEST(FlippedBits, OfRowTables)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  constexpr std::uint32_t Count = 30000;
  RowTable table(workspace, Count, sizeof(std::uint32_t), 1 << 15);
  for (std::uint32_t i = 0; i < Count; ++i)
  {
    table.put(i * 7001 % Count, std::as_bytes(std::span(&i, 1)));
  }
  table.close();
  ASSERT_GE(table.buckets(), 3);
  expectNoticedFlips(10,
    [&]
    {
      for (std::int64_t first = 0; first < table.count();)
      {
        first += static_cast<std::int64_t>(table.read(first).size() / table.rowBytes());
      }
      table.read(0); // forgets the last bucket
    });
}

TEST(FlippedBits, OfQueues)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  expectNoticedFlips(50,
    [&]
    {
      SearchQueue queue(workspace, 128);
      for (std::uint32_t i = 0; i < 1000; ++i)
      {
        queue.push(i);
      }
      while (queue.size() > 0)
      {
        queue.pop();
      }
    });
}

TEST(FlippedBits, OfPagedArrays)
{
  const TemporaryFolder folder;
  expectNoticedFlips(10,
    [&]
    {
      PagedArray<std::int64_t> array(folder.path(), 1);
      for (const int round : { 0, 1 })
      {
        for (std::int64_t i = 0; i < 20000; i += 1000)
        {
          array.at(i) += round;
        }
      }
    });
}

} // namespace smg::testing
