// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Motion/OriginalOrder.h"

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

using Tuple = std::array<double, 3>;

Tuple tupleOf(std::int64_t id)
{
  return { double(id), double(-id), 0.5 };
}

std::vector<std::int64_t> shuffledNumbers(std::int64_t count)
{
  std::vector<std::int64_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  Random random(7);
  for (std::int64_t i = count - 1; i > 0; i--)
  {
    std::swap(ids[i], ids[random.below(i + 1)]);
  }
  return ids;
}

/** Puts the tuples of the numbers, `step` at a time. */
void put(OriginalOrder& order, const std::vector<std::int64_t>& ids, std::size_t step)
{
  for (std::size_t i = 0; i < ids.size(); i += step)
  {
    const std::span some = std::span(ids).subspan(i, std::min(step, ids.size() - i));
    std::vector<Tuple> tuples;
    for (const std::int64_t id : some)
    {
      tuples.push_back(tupleOf(id));
    }
    order.put(some, std::as_bytes(std::span(tuples)));
  }
}

/** Reads a range and expects the tuple of each number for which `has` is true. */
void expectRange(OriginalOrder& order, std::int64_t first, std::int64_t count, const auto& has)
{
  std::vector<Tuple> tuples(count, Tuple{ -1, -1, -1 });
  std::vector<std::uint8_t> given(count, 7);
  order.read(first, given, std::as_writable_bytes(std::span(tuples)));
  for (std::int64_t i = 0; i < count; i++)
  {
    const bool is = has(first + i);
    ASSERT_EQ(given[i], is ? 1 : 0) << first + i;
    ASSERT_EQ(tuples[i], is ? tupleOf(first + i) : (Tuple{ -1, -1, -1 })) << first + i;
  }
}

TEST(OriginalOrder, GivesAnyOrderBackByNumber)
{
  TemporaryFolder folder;
  // 36 MB of tuples in 8 MiB: through the scratch file, and without one.
  constexpr std::int64_t count = 1500000;
  for (const std::int64_t memory : { std::int64_t(0), std::int64_t(200) << 20 })
  {
    OriginalOrder order(sizeof(Tuple), folder.path(), memory);
    put(order, shuffledNumbers(count), 777);
    EXPECT_EQ(order.end(), count);
    const auto all = [](std::int64_t id) { return id < count; };
    for (std::int64_t first = 0; first < count; first += 49999)
    {
      expectRange(order, first, 50000, all);
    }
    expectRange(order, 0, count + 10, all);
    expectRange(order, count - 1, 1, all);
    expectRange(order, 5, 0, all);
    EXPECT_EQ(folder.entries(), 0);
  }
}

TEST(OriginalOrder, KnowsWhatIsMissingAndLetsTheLastCount)
{
  TemporaryFolder folder;
  OriginalOrder order(sizeof(Tuple), folder.path(), 0);
  std::vector<std::int64_t> ids = shuffledNumbers(500000);
  std::erase_if(ids, [](std::int64_t id) { return id % 3 == 1 || (id > 50000 && id < 120000); });
  const std::vector<Tuple> wrong(ids.size(), Tuple{ 1, 2, 3 });
  order.put(ids, std::as_bytes(std::span(wrong)));
  put(order, ids, 1000);
  const auto has = [](std::int64_t id)
  { return id < 500000 && id % 3 != 1 && !(id > 50000 && id < 120000); };
  expectRange(order, 0, 550000, has);
  // Far beyond all stored tuples, without a bucket.
  expectRange(order, std::int64_t(1) << 60, 10, has);
}

TEST(OriginalOrder, LargeNumbersNeedNoMemory)
{
  TemporaryFolder folder;
  OriginalOrder order(sizeof(Tuple), folder.path(), 0);
  const std::vector<std::int64_t> ids{ 3, std::int64_t(1) << 52, 9000000000 };
  put(order, ids, 1);
  for (const std::int64_t id : ids)
  {
    expectRange(order, id - 1, 3, [id](std::int64_t i) { return i == id; });
  }
}

TEST(OriginalOrder, RefusesNegativeNumbersAndMissingFolders)
{
  TemporaryFolder folder;
  OriginalOrder order(sizeof(Tuple), folder / "missing", 0);
  expectError([&] { put(order, { 2, -1 }, 2); }, "-1 of a vertex is negative");
  expectError([&] { put(order, shuffledNumbers(1000000), 1000); }, "missing");
}

} // namespace
} // namespace smg::testing
