// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Ring.h"
#include "Solver/Core/SystemCalls.h"
#include "Solver/Memory/RaggedRing.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/Sanitized.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <numeric>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace smg::testing
{

TEST(Ring, ItemsKeepTheirValuesWhileTheWindowMovesAndGrows)
{
  Pool pool(1 << 30);
  for (const int lanes : { 1, 3, 4, 12 })
  {
    Ring<double> ring(pool, lanes);
    Random random(lanes);
    const auto value = [](std::int64_t i, int k) { return 1000.0 * static_cast<double>(i) + k; };
    for (std::int64_t first = 0, end = 0; end < 60000;)
    {
      const std::int64_t next = end + 1 + random.below(random.below(20) == 0 ? 4000 : 300);
      ring.extend(next);
      for (; end < next; ++end)
      {
        for (int k = 0; k < lanes; ++k)
        {
          ASSERT_EQ(ring.at(end)[k], 0.0);
          ring.at(end)[k] = value(end, k);
        }
      }
      for (std::int64_t i = first; i < end; i += 7)
      {
        ASSERT_EQ(ring.at(i)[lanes - 1], value(i, lanes - 1));
      }
      // The same from any item, beyond the end of the memory.
      ASSERT_EQ(ring.at(first)[lanes * (end - 1 - first)], value(end - 1, 0));
      first += random.below(end - first + 1);
      ring.release(first);
      ASSERT_EQ(ring.first(), first);
      ASSERT_EQ(ring.end(), end);
    }
  }
}

namespace
{
int mappingsBeforeFailure = 0;
decltype(SystemCalls::mmap) realMapping = nullptr;

void* failingMapping(void* address, std::size_t size, int protection, int flags, int file, off_t at)
{
  if (mappingsBeforeFailure-- == 0)
  {
    errno = ENOMEM;
    return MAP_FAILED;
  }
  return realMapping(address, size, protection, flags, file, at);
}
} // namespace

TEST(Ring, KeepsItsItemsWhenItCannotGrow)
{
  Pool pool(1 << 30);
  Ring<double> ring(pool);
  ring.extend(1000);
  std::iota(ring.at(0), ring.at(0) + 1000, 0.0);
  ring.release(300);
  const std::int64_t used = pool.used();
  realMapping = systemCalls().mmap;
  systemCalls().mmap = failingMapping;
  for (int before = 0; before < 4; ++before)
  {
    mappingsBeforeFailure = before;
    expectError([&] { ring.extend(100000); }, "no memory for a window");
    EXPECT_EQ(pool.used(), used);
    EXPECT_EQ(ring.end(), 1000);
    EXPECT_EQ(ring[300], 300.0);
    EXPECT_EQ(ring[999], 999.0);
  }
  systemCalls().mmap = realMapping;
  ring.extend(100000);
  EXPECT_EQ(ring[999], 999.0);
  EXPECT_EQ(ring[99999], 0.0);
}

TEST(Ring, TakesTheMemoryOfOneThatIsGone)
{
  Pool pool(1 << 30);
  const auto use = [&pool](double value)
  {
    Ring<double> ring(pool);
    for (std::int64_t i = 0; i < 3000; ++i)
    {
      ring.extend(i + 1);
      ASSERT_EQ(ring[i], 0.0);
      ring[i] = value;
    }
    ASSERT_EQ(std::accumulate(ring.at(0), ring.at(0) + 3000, 0.0), 3000 * value);
  };
  use(1.0);
  realMapping = systemCalls().mmap;
  systemCalls().mmap = failingMapping;
  mappingsBeforeFailure = 0;
  use(2.0);
  systemCalls().mmap = realMapping;
  EXPECT_EQ(pool.used(), 0);
}

TEST(Ring, AChildDoesNotTakeThatOfItsParent)
{
  Pool pool(1 << 30);
  auto mine = std::make_unique<Ring<int>>(pool);
  mine->extend(1000);
  Ring<int>(pool).extend(1000);
  const pid_t child = ::fork();
  if (child == 0)
  {
    // What it gives back is still in use, too.
    Ring<int> first(pool);
    first.extend(1000);
    std::ranges::fill(first.range(0, 1000), 7);
    mine.reset();
    Ring<int> second(pool);
    second.extend(1000);
    std::ranges::fill(second.range(0, 1000), 8);
    ::_exit(0);
  }
  int status = -1;
  Ring<int> other(pool);
  other.extend(1000);
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(std::ranges::count(mine->range(0, 1000), 0), 1000);
  EXPECT_EQ(std::ranges::count(other.range(0, 1000), 0), 1000);
}

TEST(Ring, NeedsMemoryForTheWindowOnly)
{
  Pool pool(1 << 30);
  Ring<std::int32_t> ring(pool);
  for (std::int64_t i = 0; i < 1000000; ++i)
  {
    ring.extendRaw(i + 1);
    ring[i] = static_cast<std::int32_t>(i);
    ring.release(i - 1000);
  }
  EXPECT_LE(pool.peak(), 4 * 4096);
  ring.clear();
  EXPECT_EQ(pool.used(), 0);
  EXPECT_EQ(ring.end(), 0);
}

TEST(Ring, StartsAgainAnywhere)
{
  Pool pool(1 << 20);
  Ring<std::int64_t> ring(pool, 2);
  ring.extend(5000);
  ring.restart(123456789);
  EXPECT_EQ(ring.first(), 123456789);
  ring.extend(123456789 + 3000);
  ring[123456789] = 1;
  ring[123456789 + 2999] = 2;
  ring.extend(123456789 + 30000);
  EXPECT_EQ(ring[123456789], 1);
  EXPECT_EQ(ring[123456789 + 2999], 2);
}

TEST(Ring, MayBeginAnywhereBeforeItHasMemory)
{
  Pool pool(1 << 30);
  Ring<int> ring(pool);
  ring.restart(1'000'003);
  ring.release(1'000'003);
  for (std::int64_t i = ring.first(); i < 1'300'000; ++i)
  {
    ring.extend(i + 1);
    ring[i] = static_cast<int>(i);
  }
  for (std::int64_t i = ring.first(); i < ring.end(); ++i)
  {
    ASSERT_EQ(ring[i], i);
  }
}

TEST(Ring, ARefusedGrowthLeavesItWhole)
{
  Pool pool(1 << 16);
  Ring<std::int64_t> ring(pool);
  ring.extend(1000);
  ring[999] = 7;
  EXPECT_THROW(ring.extend(1000000), Error);
  EXPECT_EQ(ring.end(), 1000);
  EXPECT_EQ(ring[999], 7);
  ring.extend(1500);
  EXPECT_EQ(ring[999], 7);
}

TEST(Ring, GrowsWithoutASecondCopy)
{
  Pool pool(1 << 30);
  Ring<std::int64_t> ring(pool);
  std::int64_t end = 0;
  for (std::int64_t window = 50000; window < 200000; window += 1000, ring.release(end - window))
  {
    for (const std::int64_t before = end; end < before + window / 3; ++end)
    {
      ring.extendRaw(end + 1);
      ring[end] = end;
    }
    for (std::int64_t i = ring.first(); i < end; i += 11)
    {
      ASSERT_EQ(ring[i], i);
    }
  }
  EXPECT_GT(pool.peak(), 8 * 190000);
  EXPECT_EQ(pool.peak(), pool.used());
}

TEST(RaggedRing, GrowsWithoutASecondCopy)
{
  if (!GrowsInPlace)
  {
    GTEST_SKIP() << "this build has no mremap()";
  }
  Pool pool(1 << 30);
  RaggedRing<std::int64_t> rows(pool);
  std::int64_t small = 0; // used before the memory is large enough for mremap()
  std::int64_t first = 0;
  for (std::int64_t window = 1000; window < 40000; window += 500)
  {
    for (const std::int64_t end = rows.end() + window / 3; rows.end() < end;)
    {
      const std::int64_t row = rows.end();
      std::fill_n(rows.open(8), row % 8, row);
      rows.close(row % 8);
      small = pool.used() < (1 << 18) ? pool.peak() : small;
    }
    for (std::int64_t r = first; r < rows.end(); r += 11)
    {
      ASSERT_EQ(std::vector(rows.row(r), rows.row(r) + rows.size(r)),
        std::vector<std::int64_t>(static_cast<std::size_t>(r % 8), r));
    }
    first = std::max<std::int64_t>(0, rows.end() - window);
    rows.release(first);
  }
  EXPECT_GT(pool.used(), 4 * small);
  EXPECT_EQ(pool.peak(), pool.used());
}

TEST(RaggedRing, RowsKeepTheirEntries)
{
  Pool pool(1 << 30);
  RaggedRing<std::int32_t> rows(pool);
  Random random(5);
  std::vector<std::vector<std::int32_t>> expected;
  std::int64_t first = 0;
  for (std::int64_t row = 0; row < 20000; ++row)
  {
    const std::int64_t room = random.below(random.below(100) == 0 ? 3000 : 20);
    std::int32_t* entries = rows.open(room);
    const std::int64_t size = random.below(room + 1);
    expected.emplace_back();
    for (std::int64_t e = 0; e < size; ++e)
    {
      entries[e] = static_cast<std::int32_t>(random.bits());
      expected.back().push_back(entries[e]);
    }
    rows.close(size);
    ASSERT_EQ(rows.end(), row + 1);
    if (random.below(50) == 0)
    {
      for (std::int64_t r = first; r <= row; ++r)
      {
        ASSERT_EQ(std::vector(rows.row(r), rows.row(r) + rows.size(r)), expected[r]);
      }
      first += random.below(row - first + 2);
      rows.release(first);
    }
  }
}

TEST(RaggedRing, RowsStayWhereTheyAreWhileThereIsRoom)
{
  Pool pool(1 << 30);
  RaggedRing<std::int32_t> rows(pool);
  Random random(6);
  for (int step = 0; step < 3000; ++step)
  {
    const std::int64_t more = random.below(40), entries = random.below(300);
    rows.reserve(more, entries);
    const std::int64_t used = pool.used(), before = rows.end();
    const std::int32_t* first = before > rows.first() ? rows.row(rows.first()) : nullptr;
    std::int64_t left = entries;
    for (std::int64_t k = 0; k < more; ++k)
    {
      const std::int64_t size = random.below(std::min<std::int64_t>(left, 20) + 1);
      std::fill_n(rows.open(size), size, static_cast<std::int32_t>(rows.end()));
      rows.close(size);
      left -= size;
    }
    ASSERT_EQ(pool.used(), used);
    ASSERT_TRUE(!first || rows.row(rows.first()) == first);
    for (std::int64_t row = before; row < rows.end(); ++row)
    {
      for (std::int64_t e = 0; e < rows.size(row); ++e)
      {
        ASSERT_EQ(rows.row(row)[e], row);
      }
    }
    rows.release(rows.first() + random.below(rows.end() - rows.first() + 1));
  }
}

TEST(RaggedRing, KeepsAWindowOnly)
{
  Pool pool(1 << 20);
  RaggedRing<std::int64_t> rows(pool);
  for (std::int64_t row = 0; row < 100000; ++row)
  {
    const std::int64_t size = row % 7;
    std::fill_n(rows.open(size + 3), size, row);
    rows.close(size);
    rows.release(std::max<std::int64_t>(0, row - 100));
  }
  EXPECT_LT(pool.peak(), 3 * 100 * 7 * 8 + 3 * 4096);
}

TEST(MonotoneRing, KeepsIndicesBeyond32Bits)
{
  Pool pool(1 << 20);
  constexpr std::int64_t Large = (std::int64_t(5) << 32) - 300;
  MonotoneRing ring(pool, Large);
  EXPECT_EQ(ring.last(), Large);
  for (std::int64_t i = 0; i < 1000; ++i)
  {
    ring.append(i % 3 == 0 ? Large + i : 0);
    ring.release(i - 200);
    for (std::int64_t k = std::max<std::int64_t>(0, i - 200); k <= i; ++k)
    {
      ASSERT_EQ(ring[k], Large + k / 3 * 3);
    }
  }
}

} // namespace smg::testing
